#pragma once
// Text for people: with names of files and what stands in them, and with numbers.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace rs {

// Control characters (those of Unicode's second block as UTF-8, too) and the byte 127 become \xNN, so that a name
// cannot colour, move or clear anything; everything else stays, UTF-8 or not.
std::string printable(std::string_view text);

// So many digits behind the point.
std::string with_digits(double value, int digits);

// "a, b and 3 more": the first `most`, and how many there are beside.
std::string listed(std::span<const std::string> names, std::size_t most);

}  // namespace rs
