#pragma once
// The lines of a ring as a plane of bytes, which is what the file compresses. Over the reference planes two of a view's
// four numbers are constant and two are sines, up to their rounding: so only what differs from that is stored.
// encode/FORMAT.md, section "RING", "Coded lines".

#include "rayspace/object/ray_space_object.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::line_coding {

inline constexpr std::size_t kBytesPerLine = 16;

// lines[n * planes + k] is line k of the ring's n-th view; planes kMinPlanes..kMaxPlanes. kBytesPerLine for each line.
// All numbers come back exactly, also where no line is like a camera's.
std::vector<std::uint8_t> residual_plane(std::span<const CapturedLine> lines, int planes);

// The reverse: any bytes, kBytesPerLine for each line, are those of some lines.
void put_residuals(std::span<const std::uint8_t> plane, int planes, std::span<CapturedLine> lines);

}  // namespace rs::line_coding
