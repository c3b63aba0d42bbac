#pragma once
// Byte layout of the .rso container, shared by writer and reader; encode/FORMAT.md, section "Container".

#include "rayspace/format/container.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace rs::container_layout {

/// Like PNG's signature: a byte that is not text, and line ends and an end-of-file mark that text-mode transfers
/// damage.
inline constexpr std::array<std::uint8_t, 8> kMagic = {0x89, 'R', 'S', 'O', 0x0D, 0x0A, 0x1A, 0x0A};
inline constexpr std::uint16_t kVersionMajor = 2;
inline constexpr std::uint16_t kVersionMinor = 4;

inline constexpr std::uint64_t kHeader_bytes = 48;
inline constexpr std::uint64_t kHeaderChecked_bytes = 40;  // covered by the header's checksum, which follows
inline constexpr std::uint64_t kTableOffset_bytes = kHeader_bytes;
inline constexpr std::uint64_t kEntry_bytes = 32;
inline constexpr std::uint64_t kAlignment_bytes = 16;

constexpr std::uint64_t aligned(std::uint64_t size_bytes) {
    return (size_bytes + kAlignment_bytes - 1) / kAlignment_bytes * kAlignment_bytes;
}

constexpr bool is_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

constexpr bool is_valid(ChunkName name) {
    for (const char c : name) {
        if (!is_letter(c) && !(c >= '0' && c <= '9')) return false;
    }
    return is_letter(name[0]);
}

}  // namespace rs::container_layout
