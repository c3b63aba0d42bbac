#include "rayspace/base/zstd_frame.hpp"

#include "rayspace/base/byte_stream.hpp"

#include <zstd.h>

#include <string>

namespace rs {

std::optional<std::uint64_t> read_zstd_content_size(std::span<const std::byte> bytes) {
    ByteReader start(bytes);
    if (start.get<std::uint32_t>() != ZSTD_MAGICNUMBER) return std::nullopt;
    const unsigned long long stated_bytes = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
    if (stated_bytes == ZSTD_CONTENTSIZE_UNKNOWN || stated_bytes == ZSTD_CONTENTSIZE_ERROR) return std::nullopt;
    return stated_bytes;
}

// libzstd would also accept several frames, skippable ones and frames of early versions.
Status check_zstd_frame(std::span<const std::byte> frame, std::uint64_t size_bytes, const char* what) {
    if (size_bytes == 0 && frame.empty()) return {};
    ByteReader start(frame);
    if (start.get<std::uint32_t>() != ZSTD_MAGICNUMBER || size_bytes == 0) {
        return Error{std::string(what) + " are no Zstandard frame"};
    }
    const unsigned long long stated_bytes = ZSTD_getFrameContentSize(frame.data(), frame.size());
    if (stated_bytes != size_bytes) {
        return Error{std::string(what) + " do not state the " + std::to_string(size_bytes) +
                     " bytes that they must expand to"};
    }
    if (ZSTD_findFrameCompressedSize(frame.data(), frame.size()) != frame.size()) {
        return Error{std::string(what) + " are not one whole Zstandard frame"};
    }
    return {};
}

Status decompress_zstd_frame(std::span<const std::byte> frame, std::uint64_t size_bytes, const char* what,
                             std::vector<std::uint8_t>& bytes) {
    bytes.resize(static_cast<std::size_t>(size_bytes));
    if (bytes.empty()) return {};
    const std::size_t written = ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size());
    if (ZSTD_isError(written)) {
        return Error{std::string(what) + " cannot be decompressed: " + ZSTD_getErrorName(written)};
    }
    if (written != bytes.size()) return Error{std::string(what) + " expand to too few bytes"};
    return {};
}

Result<std::vector<std::uint8_t>> decompress_zstd(std::span<const std::byte> frame, std::uint64_t size_bytes,
                                                  const char* what) {
    RS_TRY(check_zstd_frame(frame, size_bytes, what));
    std::vector<std::uint8_t> bytes;
    RS_TRY(decompress_zstd_frame(frame, size_bytes, what, bytes));
    return bytes;
}

}  // namespace rs
