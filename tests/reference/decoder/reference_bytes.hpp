#pragma once
// FORMAT.md: numbers in bytes, and the frames of planes and codebooks.

#include <zstd.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rs::reference {

inline int u16_at(std::span<const std::uint8_t> bytes, std::size_t at) {
    return bytes[at] + 256 * bytes[at + 1];
}

/// "One Zstandard frame that states its content size, without a dictionary"; no frame for no bytes.
inline std::string expand(std::span<const std::uint8_t> frame, std::size_t size, std::vector<std::uint8_t>& content) {
    content.assign(size, 0);
    if (size == 0) return frame.empty() ? "" : "a frame of nothing";
    if (ZSTD_getFrameContentSize(frame.data(), frame.size()) != size) return "a frame states another content size";
    if (ZSTD_findFrameCompressedSize(frame.data(), frame.size()) != frame.size()) return "not one whole frame";
    if (ZSTD_decompress(content.data(), size, frame.data(), frame.size()) != size) return "a frame does not expand";
    return "";
}

}  // namespace rs::reference
