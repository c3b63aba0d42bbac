#include "compositor/scene/vrml/lexer.hpp"

#include <charconv>
#include <cmath>
#include <limits>

namespace rs::compositor::vrml {
namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',';
}

bool ends_word(char c) {
    return is_space(c) || c == '#' || c == '"' || c == '[' || c == ']' || c == '{' || c == '}';
}

bool begins_number(std::string_view word) {
    const std::size_t sign = word[0] == '+' || word[0] == '-' ? 1 : 0;
    if (word.size() <= sign) return false;
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    if (is_digit(word[sign])) return true;
    return word[sign] == '.' && word.size() > sign + 1 && is_digit(word[sign + 1]);
}

}  // namespace

MalformedVrml Lexer::error(int line, const std::string& what) const {
    return {file_ + ": line " + std::to_string(line) + ": " + what};
}

void Lexer::skip_space() {
    while (position_ < text_.size()) {
        const char c = text_[position_];
        if (c == '#') {
            while (position_ < text_.size() && text_[position_] != '\n' && text_[position_] != '\r') ++position_;
            continue;
        }
        if (!is_space(c)) return;
        // Lines end in LF, CR LF or CR.
        const bool cr_lf = c == '\r' && position_ + 1 < text_.size() && text_[position_ + 1] == '\n';
        if (c == '\n' || (c == '\r' && !cr_lf)) ++line_;
        ++position_;
    }
}

void Lexer::read_text() {
    const int first_line = line_;
    const std::size_t begin = ++position_;
    for (;; ++position_) {
        if (position_ >= text_.size()) throw error(first_line, "the string that begins here is not closed; add a \"");
        const char c = text_[position_];
        if (c == '"') break;
        if (c == '\0') throw error(line_, "a zero character in a text; remove it");
        if (c == '\\') ++position_;
        if (position_ < text_.size() && text_[position_] == '\n') ++line_;
    }
    next_ = {TokenKind::text, text_.substr(begin, position_ - begin), first_line};
    ++position_;
}

void Lexer::advance() {
    skip_space();
    if (position_ >= text_.size()) {
        next_ = {TokenKind::end, {}, line_};
        return;
    }
    const auto single = [&](TokenKind kind) { next_ = {kind, text_.substr(position_++, 1), line_}; };
    switch (text_[position_]) {
        case '"':
            return read_text();
        case '[':
            return single(TokenKind::open_list);
        case ']':
            return single(TokenKind::close_list);
        case '{':
            return single(TokenKind::open_body);
        case '}':
            return single(TokenKind::close_body);
        default:
            break;
    }
    const std::size_t begin = position_;
    while (position_ < text_.size() && !ends_word(text_[position_])) ++position_;
    const std::string_view word = text_.substr(begin, position_ - begin);
    next_ = {begins_number(word) ? TokenKind::number : TokenKind::word, word, line_};
}

Token Lexer::take() {
    const Token token = next_;
    if (token.kind != TokenKind::end) advance();
    return token;
}

bool Lexer::take_word(std::string_view word) {
    if (next_.kind != TokenKind::word || next_.text != word) return false;
    advance();
    return true;
}

bool Lexer::take_kind(TokenKind kind) {
    if (next_.kind != kind) return false;
    advance();
    return true;
}

Token Lexer::expect(TokenKind kind, const char* what) {
    if (next_.kind != kind) throw error("expected " + std::string(what) + ", not " + quote(next_));
    return take();
}

std::string quote(const Token& token) {
    if (token.kind == TokenKind::end) return "the end of the file";
    constexpr std::size_t kMaxQuoted = 40;
    std::string result = "'";
    for (const char c : token.text.substr(0, kMaxQuoted)) result += c >= ' ' && c < '\x7f' ? c : '?';
    return result + (token.text.size() > kMaxQuoted ? "...'" : "'");
}

std::string unescape(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && i + 1 < text.size()) ++i;
        result += text[i];
    }
    return result;
}

bool parse_integer(std::string_view text, long& value) {
    const bool negative = !text.empty() && text[0] == '-';
    if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
    int base = 10;
    if (text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X')) {
        base = 16;
        text.remove_prefix(2);
    }
    unsigned long magnitude = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), magnitude, base);
    if (error != std::errc{} || end != text.data() + text.size()) return false;
    const unsigned long most = base == 16 ? std::numeric_limits<unsigned>::max() : std::numeric_limits<int>::max();
    if (magnitude > most) return false;
    value = negative ? -static_cast<long>(magnitude) : static_cast<long>(magnitude);
    return true;
}

bool parse_float(std::string_view text, float& value) {
    if (!text.empty() && text[0] == '+') text.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (end != text.data() + text.size()) return false;
    // Numbers too small for a double are 0.
    if (error == std::errc::result_out_of_range && std::abs(number) < 1) number = 0;
    value = static_cast<float>(number);
    return std::isfinite(value) && (error == std::errc{} || number == 0);
}

}  // namespace rs::compositor::vrml
