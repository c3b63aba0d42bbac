#pragma once
// Views as the files of a capture set count them.

#include <cstddef>
#include <cstdio>
#include <string>

namespace rs::capture {

// Three digits or more: "007". Thread-safe.
inline std::string view_number(std::size_t view) {
    char text[24];
    std::snprintf(text, sizeof text, "%03zu", view);
    return text;
}

}  // namespace rs::capture
