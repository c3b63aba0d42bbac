#include "rayspace/image_io/backend/file_checks.hpp"

#include "rayspace/image_io/backend/byte_source.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace rs::image_io {
namespace {

constexpr std::array<unsigned char, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

}  // namespace

Status check_png_integrity(const std::string& path) {
    const Error cut_short{path + ": is damaged or cut short: the file ends inside the image; copy it again"};
    ByteSource source(path);
    std::array<unsigned char, kSignature.size()> signature{};
    if (!source.take(signature.data(), signature.size()) || signature != kSignature) return {};
    std::array<unsigned char, 65536> piece;
    for (;;) {
        std::array<unsigned char, 8> head{};  // length, type
        if (!source.take(head.data(), head.size())) return cut_short;
        const unsigned char* const type = head.data() + 4;
        uLong checksum = crc32(0, type, 4);
        for (std::uint32_t left = big_endian(head.data()); left > 0;) {
            const std::uint32_t count = std::min(left, static_cast<std::uint32_t>(piece.size()));
            if (!source.take(piece.data(), count)) return cut_short;
            checksum = crc32(checksum, piece.data(), count);
            left -= count;
        }
        std::array<unsigned char, 4> stated{};
        if (!source.take(stated.data(), stated.size())) return cut_short;
        if (big_endian(stated.data()) != checksum) {
            return Error{path + ": is damaged: a checksum does not match; copy it again"};
        }
        if (std::memcmp(type, "IEND", 4) == 0) return {};
    }
}

}  // namespace rs::image_io
