#pragma once
// The inner loop of the fast core: a strip of view columns, each walking down a column of a captured image at its own
// pace, written out row by row.

#include "rayspace/image/image.hpp"

#include <cstddef>
#include <cstdint>

namespace rs::engine {

// How many view columns are walked side by side: one cache line of output.
inline constexpr int kStripColumns = 16;

// Lane n shows texels[start[n] + ((row_0[n] + j * row_step[n]) >> 16)] in view row j while begin[n] <= j < end[n], and
// is transparent elsewhere. Rows and steps are q16 modulo 2^32: what lies between begin and end fits.
struct ColumnStrip {
    alignas(64) std::int32_t start[kStripColumns];
    alignas(64) std::int32_t row_0_q16[kStripColumns];
    alignas(64) std::int32_t row_step_q16[kStripColumns];
    alignas(64) std::int32_t begin[kStripColumns];
    alignas(64) std::int32_t end[kStripColumns];
    std::int32_t first_used = 0;  // no lane shows anything outside of view rows [first_used, last_used)
    std::int32_t last_used = 0;
    std::int32_t first_full = 0;  // every lane shows something in view rows [first_full, last_full)
    std::int32_t last_full = 0;
};

// Writes `columns` (1..kStripColumns) pixels of view rows [row_begin, row_end), the first of them to `out`. The SIMD
// code for the machine at hand is chosen at the first call; all choices give the same bytes.
void walk_columns(const ColumnStrip& strip, const Rgba8* texels, int row_begin, int row_end, int columns, Rgba8* out,
                  std::ptrdiff_t stride);

}  // namespace rs::engine
