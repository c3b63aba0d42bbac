#include "tests/bench/rd/coded.hpp"

#include "rayspace/file/file_output.hpp"

#include <xxhash.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <span>
#include <sstream>

namespace rs::bench {

std::filesystem::path CodedCache::file_of(const std::string& key) const {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "%016llx.txt",
                  static_cast<unsigned long long>(XXH64(key.data(), key.size(), 0)));
    return folder_ / name.data();
}

std::optional<Coded> CodedCache::find(const std::string& key) const {
    std::ifstream file(file_of(key));
    std::string line;
    // The file contains the key, which detects hash collisions.
    if (!std::getline(file, line) || line != key) return std::nullopt;
    Coded coded;
    file >> coded.bytes >> coded.error.object_pixels >> coded.error.squared_error >> coded.error.block_pixels >>
        coded.error.alpha_error >> coded.has_alpha;
    if (!file) return std::nullopt;
    return coded;
}

Status CodedCache::store(const std::string& key, const Coded& coded) const {
    std::ostringstream text;
    text << key << '\n'
         << coded.bytes << ' ' << coded.error.object_pixels << ' ' << coded.error.squared_error << ' '
         << coded.error.block_pixels << ' ' << coded.error.alpha_error << ' ' << coded.has_alpha << '\n';
    Result<StagedFile> file = StagedFile::create(file_of(key));
    if (!file) return file.error();
    const std::string content = text.str();
    if (Status status = file->write(std::as_bytes(std::span(content))); !status) return status;
    return file->commit();
}

}  // namespace rs::bench
