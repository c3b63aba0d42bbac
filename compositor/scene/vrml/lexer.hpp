#pragma once
// The tokens of VRML97 text (ISO/IEC 14772-1, annex A), with their lines. Private to the VRML reader; errors travel as
// the exception MalformedVrml up to its one catch.

#include <string>
#include <string_view>

namespace rs::compositor::vrml {

struct MalformedVrml {
    std::string message;  // "FILE: line N: what is wrong; what to do"
};

enum class TokenKind { word, number, text, open_list, close_list, open_body, close_body, end };

struct Token {
    TokenKind kind = TokenKind::end;
    std::string_view text;  // into the file's text; of a `text` without its quotes, escapes kept
    int line = 1;
};

// Commas are white space and # begins a comment. A word is anything else that is no number: keywords, names, and
// "NODE.event".
class Lexer {
public:
    // `text` must outlive the lexer and its tokens.
    Lexer(std::string_view text, std::string file) : text_(text), file_(std::move(file)) { advance(); }

    [[nodiscard]] const Token& peek() const { return next_; }
    Token take();
    // Takes the next token if it is this word, or of this kind.
    bool take_word(std::string_view word);
    bool take_kind(TokenKind kind);
    // Takes a token that must be of this kind; `what` names it in the error.
    Token expect(TokenKind kind, const char* what);

    [[nodiscard]] MalformedVrml wrong(int line, const std::string& what) const;
    // Wrong at the next token.
    [[nodiscard]] MalformedVrml wrong(const std::string& what) const { return wrong(next_.line, what); }
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

// A token as it may be quoted in a message: short, printable.
std::string shown(const Token& token);

// The characters that a `text` stands for.
std::string unescaped(std::string_view text);

// False where the text is no whole number (decimal or 0x...) that fits. Hexadecimal ones may use all 32 bits.
bool parse_integer(std::string_view text, long& value);
// False where it is no number, or not finite as a 32-bit float.
bool parse_float(std::string_view text, float& value);

}  // namespace rs::compositor::vrml
