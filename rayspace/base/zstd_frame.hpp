#pragma once
// Zstandard frames (RFC 8878) with a content size, as used by chunks of the .rso format. Error messages begin with
// `what`, in the plural ("its rays").

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rs {

/// Compresses bytes into one frame; empty for no bytes. Deterministic for a version of libzstd.
std::vector<std::byte> compress_zstd(std::span<const std::uint8_t> bytes);

/// The content size in the header of the frame at the beginning of `bytes`; nullopt if there is no frame or no size.
/// Reads only the header.
std::optional<std::uint64_t> read_zstd_content_size(std::span<const std::byte> bytes);

/// Checks that `frame` is exactly one frame with content size `size_bytes`. Reads only the header.
Status check_zstd_frame(std::span<const std::byte> frame, std::uint64_t size_bytes, const char* what);

/// Decompresses a frame that has passed check_zstd_frame(). Writes and allocates at most size_bytes.
Status decompress_zstd_frame(std::span<const std::byte> frame, std::uint64_t size_bytes, const char* what,
                             std::vector<std::uint8_t>& bytes);

/// Checks and decompresses a frame.
Result<std::vector<std::uint8_t>> decompress_zstd(std::span<const std::byte> frame, std::uint64_t size_bytes,
                                                  const char* what);

}  // namespace rs
