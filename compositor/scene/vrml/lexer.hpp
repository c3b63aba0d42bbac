#pragma once
// Tokens of VRML97 text (ISO/IEC 14772-1, annex A) with their lines. Private to the VRML reader. Errors are thrown as
// MalformedVrml and caught in one place.

#include <string>
#include <string_view>

namespace rs::compositor::vrml {

struct MalformedVrml {
    std::string message;  // "FILE: line N: what is wrong; what to do"
};

enum class TokenKind { word, number, text, open_list, close_list, open_body, close_body, end };

struct Token {
    TokenKind kind = TokenKind::end;
    std::string_view text;  // points into the file's text; strings without quotes, escapes kept
    int line = 1;
};

/// Commas are white space, # begins a comment. Words are all tokens other than numbers, strings and brackets: keywords,
/// names, "NODE.event".
class Lexer {
public:
    /// \param text must outlive the lexer and its tokens.
    Lexer(std::string_view text, std::string file) : text_(text), file_(std::move(file)) { advance(); }

    [[nodiscard]] const Token& peek() const { return next_; }
    Token take();
    /// Consumes the next token if it is this word or of this kind.
    bool take_word(std::string_view word);
    bool take_kind(TokenKind kind);
    /// Consumes a token of the given kind, or throws.
    /// \param what name of the token in the error.
    Token expect(TokenKind kind, const char* what);

    [[nodiscard]] MalformedVrml error(int line, const std::string& what) const;
    /// Error at the next token.
    [[nodiscard]] MalformedVrml error(const std::string& what) const { return error(next_.line, what); }
    [[nodiscard]] const std::string& file() const { return file_; }

private:
    void advance();
    void skip_space();
    void read_text();

    std::string_view text_;
    std::string file_;
    std::size_t position_ = 0;
    int line_ = 1;
    Token next_;
};

/// Token for messages: quoted, shortened, printable.
std::string quote(const Token& token);

/// Characters of a string token without escapes.
std::string unescape(std::string_view text);

/// \return false unless the text is an integer (decimal or 0x...) in range. Hexadecimal numbers may use all 32 bits.
bool parse_integer(std::string_view text, long& value);
/// \return false unless the text is a number that is finite as a 32-bit float.
bool parse_float(std::string_view text, float& value);

}  // namespace rs::compositor::vrml
