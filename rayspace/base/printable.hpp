#pragma once
// Text that names of files or what stands in them are part of, for a terminal.

#include <string>
#include <string_view>

namespace rs {

// Control characters (those of Unicode's second block as UTF-8, too) and the byte 127 become \xNN, so that a name
// cannot colour, move or clear anything; everything else stays, UTF-8 or not.
std::string printable(std::string_view text);

}  // namespace rs
