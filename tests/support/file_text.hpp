#pragma once
// The contents of a file, for tests; empty if it cannot be read.

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace rs::test {

inline std::string text_in(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();  // also ends if a file of /proc disappears
    return text.str();
}

}  // namespace rs::test
