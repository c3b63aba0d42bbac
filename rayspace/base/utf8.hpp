#pragma once
// Validates UTF-8 (RFC 3629): shortest forms, no surrogates, at most U+10FFFF.

#include <cstddef>
#include <string_view>

namespace rs {

struct Utf8Character {
    std::size_t bytes = 0;  // 1 to 4; 0: the text is empty or begins with an invalid sequence
    char32_t code = 0;
};

/// The first character of a text.
Utf8Character first_utf8_character(std::string_view text);

/// True if all of the text is valid. An empty text is.
bool is_utf8(std::string_view text);

/// True if the text begins with a byte order mark of UTF-16.
bool is_utf16(std::string_view text);

}  // namespace rs
