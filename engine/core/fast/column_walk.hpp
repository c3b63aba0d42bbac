#pragma once
// Inner loop of the fast core: renders a strip of view columns row by row. Each view column samples a column of a
// captured image with its own row step.

#include "rayspace/image/image.hpp"

#include <cstddef>
#include <cstdint>

namespace rs::engine {

// View columns of a strip: one cache line of output.
inline constexpr int kStripColumns = 16;

// Pixel of lane n in view row j: texels[start[n] + ((row_0[n] + j * row_step[n]) >> 16)] for begin[n] <= j < end[n],
// else transparent. Rows and steps are q16 modulo 2^32; rows between begin and end do not overflow.
struct ColumnStrip {
    alignas(64) std::int32_t start[kStripColumns];
    alignas(64) std::int32_t row_0_q16[kStripColumns];
    alignas(64) std::int32_t row_step_q16[kStripColumns];
    alignas(64) std::int32_t begin[kStripColumns];
    alignas(64) std::int32_t end[kStripColumns];
    std::int32_t first_used = 0;  // all lanes are transparent outside of view rows [first_used, last_used)
    std::int32_t last_used = 0;
    std::int32_t first_full = 0;  // every lane reads its image in view rows [first_full, last_full)
    std::int32_t last_full = 0;
};

/// Writes `columns` (1..kStripColumns) pixels of view rows [row_begin, row_end); row_begin goes to `out`. The SIMD
/// target is chosen at the first call; all targets give the same bytes.
void walk_columns(const ColumnStrip& strip, const Rgba8* texels, int row_begin, int row_end, int columns, Rgba8* out,
                  std::ptrdiff_t stride);

}  // namespace rs::engine
