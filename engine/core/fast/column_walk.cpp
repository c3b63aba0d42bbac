#include "engine/core/fast/column_walk.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/core/fast/column_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Renders view rows [j, last) of a whole strip; row j goes to `out`. If kMasked, lanes outside of their begin..end read
// texel 0, which is transparent.
template <bool kMasked>
void walk_rows(const ColumnStrip& strip, const std::int32_t* texels, std::int32_t j, std::int32_t last,
               std::int32_t* out, std::ptrdiff_t stride) {
    const hn::CappedTag<std::int32_t, kStripColumns> d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int lane = 0; lane < kStripColumns; lane += lanes) {
        const auto start = hn::Load(d, strip.start + lane);
        const auto step = hn::Load(d, strip.row_step_q16 + lane);
        const auto begin = hn::Load(d, strip.begin + lane);
        const auto end = hn::Load(d, strip.end + lane);
        auto row = hn::Add(hn::Load(d, strip.row_0_q16 + lane), hn::Mul(step, hn::Set(d, j)));
        std::int32_t* to = out + lane;
        for (std::int32_t at = j; at < last; ++at) {
            auto index = hn::Add(start, hn::ShiftRight<16>(row));
            if constexpr (kMasked) {
                const auto now = hn::Set(d, at);
                index = hn::IfThenElseZero(hn::AndNot(hn::Lt(now, begin), hn::Lt(now, end)), index);
            }
            hn::StoreU(hn::GatherIndex(d, texels, index), d, to);
            row = hn::Add(row, step);
            to += stride;
        }
    }
}

void clear_rows(std::int32_t rows, std::int32_t* out, std::ptrdiff_t stride) {
    for (std::int32_t row = 0; row < rows; ++row) {
        std::memset(out + row * stride, 0, kStripColumns * sizeof(std::int32_t));
    }
}

void walk_whole_strip(const ColumnStrip& strip, const std::int32_t* texels, std::int32_t row_begin,
                      std::int32_t row_end, std::int32_t* out, std::ptrdiff_t stride) {
    const auto within = [&](std::int32_t row) { return std::clamp(row, row_begin, row_end); };
    const std::int32_t used = within(strip.first_used);
    const std::int32_t unused = std::max(used, within(strip.last_used));
    const std::int32_t full = std::clamp(strip.first_full, used, unused);
    const std::int32_t partial = std::clamp(strip.last_full, full, unused);
    const auto at = [&](std::int32_t row) { return out + (row - row_begin) * stride; };
    clear_rows(used - row_begin, out, stride);
    walk_rows<true>(strip, texels, used, full, at(used), stride);
    walk_rows<false>(strip, texels, full, partial, at(full), stride);
    walk_rows<true>(strip, texels, partial, unused, at(partial), stride);
    clear_rows(row_end - unused, at(unused), stride);
}

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::engine {

HWY_EXPORT(walk_whole_strip);

void walk_columns(const ColumnStrip& strip, const Rgba8* texels, int row_begin, int row_end, int columns, Rgba8* out,
                  std::ptrdiff_t stride) {
    static_assert(sizeof(Rgba8) == sizeof(std::int32_t));
    const auto* source = reinterpret_cast<const std::int32_t*>(texels);
    if (columns == kStripColumns) {
        HWY_DYNAMIC_DISPATCH(walk_whole_strip)
        (strip, source, row_begin, row_end, reinterpret_cast<std::int32_t*>(out), stride);
        return;
    }
    // Right edge of the view: renders a whole strip into a buffer, a few rows at a time, and copies the columns.
    constexpr int kRows = 64;
    alignas(64) std::int32_t buffer[kRows * kStripColumns];
    for (int first = row_begin; first < row_end; first += kRows) {
        const int last = std::min(first + kRows, row_end);
        HWY_DYNAMIC_DISPATCH(walk_whole_strip)
        (strip, source, first, last, buffer, kStripColumns);
        for (int j = first; j < last; ++j) {
            std::memcpy(static_cast<void*>(out + (j - row_begin) * stride), buffer + (j - first) * kStripColumns,
                        static_cast<std::size_t>(columns) * sizeof(Rgba8));
        }
    }
}

}  // namespace rs::engine
#endif  // HWY_ONCE
