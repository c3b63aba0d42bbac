#pragma once
// Lines and numbers of photometric files, as they come: Latin-1 or UTF-8, any line end, any spaces, commas for points
// or for spaces. Every error names the line.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rs {

// Without their ends ("\n", "\r\n", "\r").
std::vector<std::string_view> split_lines(std::string_view text);

// As it is where it is UTF-8, else read as Latin-1. Control characters become spaces; none stands at the ends.
std::string utf8_text(std::string_view bytes);

// The whole of `word` as a finite number; "+1", "1.", "1e3" and, in Fortran's way, "1D3" are numbers.
bool parse_number(std::string_view word, double& number);

// Numbers that stand anywhere from a line on, separated by spaces or commas.
class NumberStream {
public:
    NumberStream(std::string name, const std::vector<std::string_view>& lines, std::size_t first_line)
        : name_(std::move(name)), lines_(lines), line_(first_line) {}

    // `what` names the number in errors.
    Result<double> next(const std::string& what);
    Result<std::vector<double>> next(std::size_t count, const std::string& what);
    // A whole number within bounds.
    Result<int> next_whole(const std::string& what, int least, int most);
    // Whether nothing but spaces is left.
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
