#pragma once
// What stands in a file, for tests; empty where it cannot be read.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace rs::test {

inline std::string text_in(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace rs::test
