// Compression of Zstandard frames. A source of its own, so that programs that only read objects can be linked without
// the compressor (compositor/web/core).

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/zstd_frame.hpp"

#include <zstd.h>

namespace rs {
namespace {

constexpr int kCompressionLevel = 19;  // higher levels require larger decoder windows

}  // namespace

std::vector<std::byte> compress_zstd(std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) return {};
    std::vector<std::byte> frame(ZSTD_compressBound(bytes.size()));
    const std::size_t size = ZSTD_compress(frame.data(), frame.size(), bytes.data(), bytes.size(), kCompressionLevel);
    RS_CHECK(!ZSTD_isError(size));  // the buffer is large enough
    frame.resize(size);
    return frame;
}

}  // namespace rs
