#pragma once
// Lines and numbers of photometric files: Latin-1 or UTF-8, any line end, numbers separated by spaces or commas. Every
// error names the line.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rs {

// Splits a text at "\n", "\r\n" and "\r".
std::vector<std::string_view> split_lines(std::string_view text);

// Converts Latin-1 to UTF-8, unless the text is UTF-8 already. Control characters become spaces; leading and trailing
// spaces are removed.
std::string utf8_text(std::string_view bytes);

// Parses all of `word` as a finite number; accepts "+1", "1.", "1e3" and the Fortran form "1D3".
bool parse_number(std::string_view word, double& number);

// Sequence of numbers from a line on, separated by spaces, commas or line ends.
class NumberStream {
public:
    NumberStream(std::string name, const std::vector<std::string_view>& lines, std::size_t first_line)
        : name_(std::move(name)), lines_(lines), line_(first_line) {}

    // `what` describes the number in errors.
    Result<double> next(const std::string& what);
    Result<std::vector<double>> next(std::size_t count, const std::string& what);
    // Integer within bounds.
    Result<int> next_integer(const std::string& what, int least, int most);
    // Returns true if only separators are left.
    [[nodiscard]] bool at_end();
    [[nodiscard]] Error error(const std::string& problem) const;

private:
    bool skip_spaces();
    std::string name_;
    const std::vector<std::string_view>& lines_;
    std::size_t line_;
    std::size_t column_ = 0;
};

}  // namespace rs
