#include "compositor/scene/vrml/field_values.hpp"

#include <utility>

namespace rs::compositor::vrml {
namespace {

constexpr long kMaxSide = 8192;  // image side, px
constexpr long kMaxPixels = 1L << 24;
constexpr std::size_t kMaxString_bytes = 1 << 16;

class ValueReader {
public:
    ValueReader(Lexer& lexer, const FieldSpec& spec, const std::string& field)
        : lexer_(lexer), spec_(spec), field_(field) {}

    Value read() {
        const Token first = lexer_.peek();
        if (!spec_.many && first.kind == TokenKind::open_list) throw type_error();
        if (!spec_.many || !lexer_.take_kind(TokenKind::open_list)) {
            read_single();
            return std::move(value_);
        }
        while (!lexer_.take_kind(TokenKind::close_list)) {
            if (lexer_.peek().kind == TokenKind::end) {
                throw lexer_.error(first.line, "the list of " + field_ + " is not closed; add a ]");
            }
            read_single();
        }
        return std::move(value_);
    }

private:
    [[nodiscard]] MalformedVrml type_error() const {
        return lexer_.error(field_ + " takes " + field_type_name(spec_) + ", not " + quote(lexer_.peek()) +
                            "; correct it");
    }

    void read_single() {
        switch (spec_.type) {
            case FieldType::kBool:
                return read_bool();
            case FieldType::kString:
                return read_text();
            case FieldType::kImage:
                value_.numbers = read_image(lexer_, field_, [&] { return take_integer(); });
                return;
            case FieldType::kInt32:
                return read_integer();
            default:
                for (int i = 0; i < numbers_in(spec_.type); ++i) read_number();
        }
    }

    void read_bool() {
        const bool yes = lexer_.peek().text == "TRUE";
        if (lexer_.peek().kind != TokenKind::word || (!yes && lexer_.peek().text != "FALSE")) throw type_error();
        lexer_.take();
        value_.numbers.push_back(yes ? 1 : 0);
    }

    void read_text() {
        if (lexer_.peek().kind != TokenKind::text) throw type_error();
        const Token token = lexer_.take();
        if (token.text.size() > kMaxString_bytes) {
            throw lexer_.error(token.line, "a text of " + std::to_string(token.text.size()) + " bytes; shorten it");
        }
        value_.texts.push_back(unescape(token.text));
    }

    long take_integer() {
        long value = 0;
        if (lexer_.peek().kind != TokenKind::number || !parse_integer(lexer_.peek().text, value)) throw type_error();
        lexer_.take();
        return value;
    }

    void read_integer() {
        // Hexadecimal numbers may use the sign bit.
        value_.numbers.push_back(static_cast<int>(static_cast<unsigned>(take_integer())));
    }

    void read_number() {
        float value = 0;
        if (lexer_.peek().kind != TokenKind::number) throw type_error();
        if (!parse_float(lexer_.peek().text, value)) {
            throw lexer_.error(field_ + ": " + quote(lexer_.peek()) + " is not a number in range; correct it");
        }
        lexer_.take();
        value_.numbers.push_back(static_cast<double>(value));
    }

    Lexer& lexer_;
    const FieldSpec& spec_;
    const std::string& field_;
    Value value_;
};

}  // namespace

std::vector<double> read_image(Lexer& lexer, const std::string& field, const std::function<long()>& take_integer) {
    const int line = lexer.peek().line;
    const long width = take_integer();
    const long height = take_integer();
    const long components = take_integer();
    if (width < 0 || height < 0 || width > kMaxSide || height > kMaxSide || components < 0 || components > 4 ||
        (width > 0 && height > kMaxPixels / width)) {
        throw lexer.error(line, field + ": an image of " + std::to_string(width) + "x" + std::to_string(height) +
                                    " with " + std::to_string(components) + " components; it cannot be read");
    }
    std::vector<double> numbers;
    for (const long number : {width, height, components}) numbers.push_back(static_cast<double>(number));
    for (long i = 0; i < width * height; ++i) numbers.push_back(static_cast<unsigned>(take_integer()));
    return numbers;
}

Value read_value(Lexer& lexer, const FieldSpec& spec, const std::string& field) {
    return ValueReader(lexer, spec, field).read();
}

void skip_to_close(Lexer& lexer, int opened_at_line) {
    for (long open = 1; open > 0;) {
        const Token token = lexer.take();
        switch (token.kind) {
            case TokenKind::open_list:
            case TokenKind::open_body:
                ++open;
                break;
            case TokenKind::close_list:
            case TokenKind::close_body:
                --open;
                break;
            case TokenKind::end:
                throw lexer.error(opened_at_line, "the bracket opened here is not closed; add a } or ]");
            default:
                break;
        }
    }
}

void skip_value(Lexer& lexer) {
    const Token first = lexer.peek();
    switch (first.kind) {
        case TokenKind::open_list:
        case TokenKind::open_body:
            lexer.take();
            return skip_to_close(lexer, first.line);
        case TokenKind::number:
            while (lexer.peek().kind == TokenKind::number) lexer.take();
            return;
        case TokenKind::text:
            lexer.take();
            return;
        case TokenKind::word: {
            lexer.take();
            const bool has_name = first.text == "DEF" || first.text == "USE" || first.text == "IS";
            if (has_name) lexer.expect(TokenKind::word, "a name");
            if (first.text == "DEF") lexer.expect(TokenKind::word, "a node");
            if (lexer.peek().kind == TokenKind::open_body) {
                const int line = lexer.take().line;
                skip_to_close(lexer, line);
            }
            return;
        }
        case TokenKind::close_list:
        case TokenKind::close_body:
        case TokenKind::end:
            return;
    }
}

}  // namespace rs::compositor::vrml
