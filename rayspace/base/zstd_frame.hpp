#pragma once
// One Zstandard frame (RFC 8878) that states its content size, as chunks of the .rso format hold it. Errors begin with
// `what`, in the plural ("its rays").

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rs {

// Of no bytes: no frame either. The same bytes give the same frame, with the same version of libzstd.
std::vector<std::byte> zstd_frame(std::span<const std::uint8_t> bytes);

// The size that the frame at the beginning of `bytes` states for its content; nothing where there is none, or none is
// stated. Looks at its head only.
std::optional<std::uint64_t> stated_zstd_bytes(std::span<const std::byte> bytes);

// `frame` must be one whole frame that states `size_bytes`, and nothing else. Looks at its head only.
Status check_zstd_frame(std::span<const std::byte> frame, std::uint64_t size_bytes, const char* what);

// Expands a frame that has passed check_zstd_frame(): no more than size_bytes are written or allocated.
Status expand_zstd_frame(std::span<const std::byte> frame, std::uint64_t size_bytes, const char* what,
                         std::vector<std::uint8_t>& bytes);

// Both, one after the other.
Result<std::vector<std::uint8_t>> zstd_content(std::span<const std::byte> frame, std::uint64_t size_bytes,
                                               const char* what);

}  // namespace rs
