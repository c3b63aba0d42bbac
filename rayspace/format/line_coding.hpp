#pragma once
// Codes the lines of a ring as a byte plane for compression. Over the reference planes, two of a view's four numbers
// are constant and two are sinusoidal, up to rounding; only the residuals are stored. encode/FORMAT.md, section "RING",
// "Coded lines".

#include "rayspace/object/ray_space_object.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::line_coding {

inline constexpr std::size_t kBytesPerLine = 16;

/// Encodes the residuals, kBytesPerLine per line, without loss for any values. lines[n * planes + k] is line k of the
/// ring's n-th view; planes kMinPlanes..kMaxPlanes.
std::vector<std::uint8_t> encode_residuals(std::span<const CapturedLine> lines, int planes);

/// Decodes the residuals; any bytes, kBytesPerLine per line, are valid.
void decode_residuals(std::span<const std::uint8_t> plane, int planes, std::span<CapturedLine> lines);

}  // namespace rs::line_coding
