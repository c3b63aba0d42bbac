#include "rayspace/base/printable.hpp"

#include <algorithm>
#include <cstdio>

namespace rs {

std::string printable(std::string_view text) {
    std::string shown;
    const auto escape = [&](unsigned char byte) {
        char code[8];
        std::snprintf(code, sizeof code, "\\x%02X", byte);
        shown += code;
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : '\0');
        if (byte == 0xC2 && next >= 0x80 && next <= 0x9F) {  // U+0080..U+009F
            escape(byte);
            escape(next);
            ++i;
        } else if (byte < 0x20 || byte == 0x7F) {
            escape(byte);
        } else {
            shown += text[i];
        }
    }
    return shown;
}

std::string format_fixed(double value, int digits) {
    char text[512];  // the largest double has 309 digits before the point
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

std::string listed(std::span<const std::string> names, std::size_t most) {
    std::string text;
    for (std::size_t i = 0; i < std::min(most, names.size()); ++i) text += (i > 0 ? ", " : "") + names[i];
    return names.size() > most ? text + " and " + std::to_string(names.size() - most) + " more" : text;
}

}  // namespace rs
