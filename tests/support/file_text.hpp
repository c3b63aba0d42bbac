#pragma once
// What stands in a file, for tests; empty where it cannot be read.

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace rs::test {

inline std::string text_in(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();  // which also ends where a process of /proc has gone
    return text.str();
}

}  // namespace rs::test
