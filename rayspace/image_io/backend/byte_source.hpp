#pragma once
// Sequential reader for file headers, which are checked before OpenImageIO opens a file.

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>

namespace rs::image_io {

inline std::uint32_t big_endian(const unsigned char* bytes) {
    return std::uint32_t{bytes[0]} << 24U | std::uint32_t{bytes[1]} << 16U | std::uint32_t{bytes[2]} << 8U | bytes[3];
}

class ByteSource {
public:
    explicit ByteSource(const std::string& path) : stream_(path, std::ios::binary) {}

    /// Reads `count` bytes; false if the file ends before.
    bool take(unsigned char* to, std::size_t count) {
        stream_.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(count));
        return static_cast<bool>(stream_);
    }
    /// Reads up to `count` bytes; returns their number.
    std::size_t take_some(unsigned char* to, std::size_t count) {
        take(to, count);
        return static_cast<std::size_t>(stream_.gcount());
    }
    bool skip(std::uint64_t count) {
        return static_cast<bool>(stream_.seekg(static_cast<std::streamoff>(count), std::ios::cur));
    }
    void go_to(std::uint64_t at) {
        stream_.clear();
        stream_.seekg(static_cast<std::streamoff>(at));
    }

private:
    std::ifstream stream_;
};

}  // namespace rs::image_io
