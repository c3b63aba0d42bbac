#pragma once
// JPEG files like those of a camera, with an EXIF header that contains only the orientation and the focal length.

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>

namespace rs::test {

inline std::string bytes(std::initializer_list<int> values) {
    std::string text;
    for (const int value : values) text += static_cast<char>(value);
    return text;
}

/// The EXIF segment. `orientation` is written unchecked, valid (1..8) or not; the focal length is omitted if
/// `focal_35mm` is 0.
inline std::string exif_segment(int orientation, int focal_35mm) {
    const auto entry = [](int tag, int type, int value) {  // little-endian, one value
        return bytes({tag & 0xFF, tag >> 8, type, 0, 1, 0, 0, 0, value & 0xFF, value >> 8, 0, 0});
    };
    constexpr int kShort = 3, kLong = 4, kOrientation = 0x0112, kExifDirectory = 0x8769,
                  kFocalLengthIn35mmFilm = 0xA405;
    std::string tiff = bytes({'I', 'I', 42, 0, 8, 0, 0, 0});
    if (focal_35mm == 0) {
        tiff += bytes({1, 0}) + entry(kOrientation, kShort, orientation) + bytes({0, 0, 0, 0});
    } else {
        const int behind = 8 + 2 + 2 * 12 + 4;
        tiff += bytes({2, 0}) + entry(kOrientation, kShort, orientation) + entry(kExifDirectory, kLong, behind) +
                bytes({0, 0, 0, 0});
        tiff += bytes({1, 0}) + entry(kFocalLengthIn35mmFilm, kShort, focal_35mm) + bytes({0, 0, 0, 0});
    }
    const std::string exif = bytes({'E', 'x', 'i', 'f', 0, 0}) + tiff;
    return bytes({0xFF, 0xE1, 0, static_cast<int>(exif.size()) + 2}) + exif;
}

/// Inserts a segment before all others of a JPEG file.
inline void insert_segment(const std::filesystem::path& path, const std::string& segment) {
    std::string file;
    {
        std::ifstream in(path, std::ios::binary);
        file.assign(std::istreambuf_iterator<char>(in), {});
    }
    std::ofstream(path, std::ios::binary) << file.substr(0, 2) << segment << file.substr(2);
}

inline void add_exif(const std::filesystem::path& path, int orientation, int focal_35mm = 0) {
    insert_segment(path, exif_segment(orientation, focal_35mm));
}

/// Adds an ICC profile of at most 60 kB.
inline void add_profile(const std::filesystem::path& path, const std::string& icc) {
    const std::string payload = std::string("ICC_PROFILE") + bytes({0, 1, 1}) + icc;
    const int size = static_cast<int>(payload.size()) + 2;
    insert_segment(path, bytes({0xFF, 0xE2, size >> 8, size & 0xFF}) + payload);
}

/// Writes 8 x 8 grey pixels.
inline void write_oriented_jpeg(const std::filesystem::path& path, int orientation, int focal_35mm = 0) {
    const std::string one_code = bytes({1}) + std::string(16, '\0');  // a single code, one bit long, for symbol 0
    std::ofstream(path, std::ios::binary)
        << bytes({0xFF, 0xD8}) << exif_segment(orientation, focal_35mm)     //
        << bytes({0xFF, 0xDB, 0, 67, 0}) << std::string(64, '\x10')         // one quantisation table
        << bytes({0xFF, 0xC0, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0})         // 8 x 8, one component
        << bytes({0xFF, 0xC4, 0, 20, 0x00}) << one_code                     // DC
        << bytes({0xFF, 0xC4, 0, 20, 0x10}) << one_code                     // AC
        << bytes({0xFF, 0xDA, 0, 8, 1, 1, 0, 0, 63, 0, 0x3F, 0xFF, 0xD9});  // one block: DC 0, end
}

}  // namespace rs::test
