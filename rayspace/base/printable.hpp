#pragma once
// Formats text for display: names from files, and numbers.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace rs {

/// Replaces control characters (including C1 as UTF-8, and byte 127) by \xNN, so that a name cannot send terminal
/// commands. All other bytes are kept, valid UTF-8 or not.
std::string printable(std::string_view text);

/// Formats a number with a fixed number of digits after the decimal point.
std::string format_fixed(double value, int digits);

/// "a, b and 3 more": the first `most` names and the number of the others.
std::string listed(std::span<const std::string> names, std::size_t most);

}  // namespace rs
