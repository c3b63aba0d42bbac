#pragma once
// PNG files with a wrong size and a valid checksum in the header.

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace rs::test {

/// Overwrites the size. `png` begins with signature and IHDR.
inline void claim_size(std::span<std::byte> png, std::uint32_t width, std::uint32_t height) {
    const auto put_big_endian = [&](std::size_t at, std::uint32_t n) {
        for (std::size_t i = 0; i < 4; ++i) png[at + i] = static_cast<std::byte>(n >> (24 - 8 * i));
    };
    put_big_endian(16, width);
    put_big_endian(20, height);
    const auto checked = png.subspan(12, 17);  // the chunk's type and data
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
    put_big_endian(29, static_cast<std::uint32_t>(sum));
}

}  // namespace rs::test
