#include "rayspace/light/photometric_text.hpp"

#include "rayspace/base/utf8.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace rs {
namespace {

constexpr std::string_view kSeparators = " \t\v\f,\x1a";  // 0x1a: end-of-file character of DOS

}  // namespace

std::vector<std::string_view> split_lines(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        lines.push_back(text.substr(0, end));
        const bool both = end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n';
        text.remove_prefix(std::min(end + (both ? 2 : 1), text.size()));
    }
    return lines;
}

std::string utf8_text(std::string_view bytes) {
    const bool utf8 = is_utf8(bytes);
    std::string text;
    for (const char c : bytes) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x20 || code == 0x7F) {
            text += ' ';
        } else if (code < 0x80 || utf8) {
            text += c;
        } else if (code < 0xA0) {
            text += '?';  // Latin-1 control character, usually a Windows-1252 quotation mark
        } else {
            text += static_cast<char>(0xC0U | (code >> 6U));
            text += static_cast<char>(0x80U | (code & 0x3FU));
        }
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
    return text;
}

bool parse_number(std::string_view word, double& number) {
    if (word.starts_with('+')) word.remove_prefix(1);
    std::string plain(word);
    for (char& c : plain) {
        if (c == 'D' || c == 'd') c = 'e';
    }
    const auto [end, fault] = std::from_chars(plain.data(), plain.data() + plain.size(), number);
    return fault == std::errc() && end == plain.data() + plain.size() && std::isfinite(number);
}

bool NumberStream::skip_spaces() {
    for (; line_ < lines_.size(); ++line_, column_ = 0) {
        column_ = lines_[line_].find_first_not_of(kSeparators, column_);
        if (column_ != std::string_view::npos) return true;
    }
    return false;
}

bool NumberStream::at_end() {
    return !skip_spaces();
}

Error NumberStream::error(const std::string& problem) const {
    return Error{name_ + ": line " + std::to_string(std::min(line_ + 1, std::max<std::size_t>(lines_.size(), 1))) +
                 ": " + problem};
}

Result<double> NumberStream::next(const std::string& what) {
    if (!skip_spaces()) return error("the file ends before " + what + "; check that it is complete");
    const std::string_view rest = lines_[line_].substr(column_);
    const std::string_view word = rest.substr(0, std::min(rest.find_first_of(kSeparators), rest.size()));
    double number = 0;
    if (!parse_number(word, number)) {
        return error("'" + utf8_text(word.substr(0, 40)) + "' is not a number; expected " + what);
    }
    column_ += word.size();
    return number;
}

Result<std::vector<double>> NumberStream::next(std::size_t count, const std::string& what) {
    std::vector<double> numbers;
    while (numbers.size() < count) {
        RS_ASSIGN_OR_RETURN(const double number, next(what + " " + std::to_string(numbers.size() + 1)));
        numbers.push_back(number);
    }
    return numbers;
}

Result<int> NumberStream::next_integer(const std::string& what, int least, int most) {
    RS_ASSIGN_OR_RETURN(const double number, next(what));
    if (number != std::floor(number) || number < least || number > most) {
        return error(what + " is " + std::to_string(number) + "; it must be a whole number, " + std::to_string(least) +
                     ".." + std::to_string(most));
    }
    return static_cast<int>(number);
}

}  // namespace rs
