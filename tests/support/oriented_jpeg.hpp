#pragma once
// A tiny JPEG file as a camera would turn it: 8 x 8 grey pixels behind an EXIF header that holds nothing but the
// orientation.

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>

namespace rs::test {

inline std::string bytes(std::initializer_list<int> values) {
    std::string text;
    for (const int value : values) text += static_cast<char>(value);
    return text;
}

// `orientation` is written as it is, valid (1..8) or not.
inline void write_oriented_jpeg(const std::filesystem::path& path, int orientation) {
    // A TIFF directory, little-endian, of one entry: tag 274, type short, one value.
    const std::string tiff = bytes({'I', 'I', 42, 0, 8, 0, 0, 0, 1, 0, 0x12, 0x01, 3, 0, 1, 0, 0, 0}) +
                             bytes({orientation & 0xFF, orientation >> 8, 0, 0, 0, 0, 0, 0});
    const std::string exif = bytes({'E', 'x', 'i', 'f', 0, 0}) + tiff;
    const std::string one_code = bytes({1}) + std::string(16, '\0');  // a single code, one bit long, for symbol 0
    std::ofstream(path, std::ios::binary)
        << bytes({0xFF, 0xD8, 0xFF, 0xE1, 0, static_cast<int>(exif.size()) + 2}) << exif  //
        << bytes({0xFF, 0xDB, 0, 67, 0}) << std::string(64, '\x10')                       // one quantisation table
        << bytes({0xFF, 0xC0, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0})                       // 8 x 8, one component
        << bytes({0xFF, 0xC4, 0, 20, 0x00}) << one_code                                   // DC
        << bytes({0xFF, 0xC4, 0, 20, 0x10}) << one_code                                   // AC
        << bytes({0xFF, 0xDA, 0, 8, 1, 1, 0, 0, 63, 0, 0x3F, 0xFF, 0xD9});                // one block: DC 0, end
}

}  // namespace rs::test
