#include "engine/core/fast/surface_column.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/core/fast/surface_column.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Halves = hn::CappedTag<std::int16_t, kSurfaceLanes>;
using Half = hn::Vec<Halves>;

HWY_INLINE Half half(int value) {
    return hn::Set(Halves(), static_cast<std::int16_t>(value));
}

struct SurfaceHalves {
    Half depth_q3;  // -1: nothing
    Half back;
    Half farthest_q3;  // of both lines; -1: one of them has nothing
};

// between_lines() of as many bands as a vector has.
HWY_INLINE SurfaceHalves between_lines(const ShapeCell* first_cells, const ShapeCell* second_cells, int part,
                                       int jump) {
    const Half zero = hn::Zero(Halves());
    const Half first = hn::LoadU(Halves(), reinterpret_cast<const std::int16_t*>(first_cells));
    const Half second = hn::LoadU(Halves(), reinterpret_cast<const std::int16_t*>(second_cells));
    const auto depth_of = [](Half cell) { return hn::And(cell, half(255)); };
    const auto back_of = [](Half cell) { return hn::And(hn::ShiftRight<8>(cell), half(255)); };
    const Half first_back = back_of(first);
    const Half second_back = part > 0 ? back_of(second) : zero;
    const auto has_first = hn::Gt(first_back, zero);
    const auto has_second = hn::Gt(second_back, zero);
    const Half first_q3 = hn::ShiftLeft<3>(depth_of(first));
    const Half second_q3 = hn::ShiftLeft<3>(depth_of(second));
    const Half apart = hn::Sub(depth_of(second), depth_of(first));
    const Half smooth = hn::Add(first_q3, hn::Mul(apart, half(part)));
    const Half both = hn::IfThenElse(hn::Gt(hn::Abs(apart), half(jump)), part < 4 ? first_q3 : second_q3, smooth);
    const Half of_first = hn::IfThenElse(has_second, both, first_q3);
    const Half of_second = hn::IfThenElse(has_second, second_q3, half(-1));
    const auto has_both = hn::Gt(hn::Min(first_back, back_of(second)), zero);
    return {hn::IfThenElse(has_first, of_first, of_second), hn::Max(first_back, second_back),
            hn::IfThenElse(has_both, hn::Max(first_q3, second_q3), half(-1))};
}

// The bands of one of the two p, with nothing at either end.
struct BandHalves {
    std::vector<std::int16_t> depth_q3;
    std::vector<std::int16_t> back;
    std::vector<std::int16_t> farthest_q3;
};

void lay_bands(const ShapeCell* first, const ShapeCell* second, int bands, int part, int jump, int margin,
               BandHalves& out) {
    const int lanes = static_cast<int>(hn::Lanes(Halves()));
    const auto length = static_cast<std::size_t>(bands + 2 * margin + lanes);
    out.depth_q3.assign(length, -1);
    out.back.assign(length, 0);
    out.farthest_q3.assign(length, -1);
    const int rest_count = bands % lanes;
    int band = 0;
    const auto lay = [&](const ShapeCell* f, const ShapeCell* s) {
        const SurfaceHalves surfaces = between_lines(f, s, part, jump);
        hn::StoreU(surfaces.depth_q3, Halves(), out.depth_q3.data() + margin + band);
        hn::StoreU(surfaces.back, Halves(), out.back.data() + margin + band);
        hn::StoreU(surfaces.farthest_q3, Halves(), out.farthest_q3.data() + margin + band);
    };
    for (; band < bands - rest_count; band += lanes) lay(first + band, second + band);
    if (rest_count == 0) return;
    // What is behind the last band belongs to another column, or to nobody.
    ShapeCell rest[2][kSurfaceLanes] = {};
    std::copy_n(first + band, rest_count, rest[0]);
    std::copy_n(second + band, rest_count, rest[1]);
    lay(rest[0], rest[1]);
}

SurfaceColumn lay_column(const CellColumns& columns, int bands, int jump, std::size_t start, SurfaceEntries& entries) {
    constexpr int kMargin = 2;
    static thread_local BandHalves of_p[2];
    for (int p = 0; p < 2; ++p) {
        lay_bands(columns.at[p][0], columns.at[p][1], bands, columns.line_part, jump, kMargin, of_p[p]);
    }
    const auto is_empty = [&](int band) {
        const auto n = static_cast<std::size_t>(band + kMargin);
        return (of_p[0].back[n] | of_p[1].back[n]) == 0;
    };
    int low = 0;
    int high = bands;
    while (low < bands && is_empty(low)) ++low;
    if (low == bands) return lay_nothing(start, entries);
    while (is_empty(high - 1)) --high;

    SurfaceColumn column;
    column.first_band = low - 2;
    column.last = high - low + 2;
    const int lanes = static_cast<int>(hn::Lanes(Halves()));
    const Halves halves;
    const Half zero = hn::Zero(halves);
    Half nearest = half(8 * 256);
    Half farthest_back = zero;
    for (int n = 0; n <= column.last; n += lanes) {
        const auto from = static_cast<std::size_t>(low + n);  // first_band + n + kMargin
        Half depth[2][2];                                     // [p][band]
        Half low_sum[2];
        Half back = zero;
        Half farthest = zero;
        Half lacking = zero;  // -1 where one of the eight cells has no surface
        for (std::size_t b = 0; b < 2; ++b) {
            for (std::size_t p = 0; p < 2; ++p) {
                depth[p][b] = hn::LoadU(halves, of_p[p].depth_q3.data() + from + b);
                back = hn::Max(back, hn::LoadU(halves, of_p[p].back.data() + from + b));
                const Half of_lines = hn::LoadU(halves, of_p[p].farthest_q3.data() + from + b);
                farthest = hn::Max(farthest, of_lines);
                lacking = hn::Min(lacking, of_lines);
            }
            low_sum[b] =
                hn::Add(hn::Mul(depth[0][b], half(8 - columns.p_part)), hn::Mul(depth[1][b], half(columns.p_part)));
        }
        const Half least = hn::Min(hn::Min(depth[0][0], depth[0][1]), hn::Min(depth[1][0], depth[1][1]));
        const Half most = hn::Max(hn::Max(depth[0][0], depth[0][1]), hn::Max(depth[1][0], depth[1][1]));
        const auto is_smooth = hn::AndNot(hn::Lt(least, zero), hn::Not(hn::Gt(hn::Sub(most, least), half(8 * jump))));
        const Half otherwise = hn::IfThenElse(
            hn::Lt(most, zero), half(static_cast<std::int16_t>(kSurfaceNothing - (1 << 16))), half(kSurfaceSteps));
        const Half lower = hn::IfThenElse(is_smooth, low_sum[0], otherwise);
        const Half upper = hn::IfThenElseZero(is_smooth, hn::Sub(low_sum[1], low_sum[0]));
        const std::size_t to = start + static_cast<std::size_t>(n);
        hn::StoreInterleaved2(lower, upper, halves, reinterpret_cast<std::int16_t*>(entries.smooth.data() + to));
        hn::StoreInterleaved2(depth[0][0], depth[1][0], halves,
                              reinterpret_cast<std::int16_t*>(entries.pairs.data() + to));
        hn::StoreInterleaved2(back, hn::Or(farthest, lacking), halves,
                              reinterpret_cast<std::int16_t*>(entries.backs.data() + to));
        for (const auto& both_bands : depth) {
            for (const Half d : both_bands) nearest = hn::Min(nearest, hn::IfThenElse(hn::Lt(d, zero), nearest, d));
        }
        farthest_back = hn::Max(farthest_back, back);
    }
    column.nearest = hn::GetLane(hn::MinOfLanes(halves, nearest)) >> 3;
    column.beyond = hn::GetLane(hn::MaxOfLanes(halves, farthest_back)) + 1;
    return column;
}

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::engine {

HWY_EXPORT(lay_column);

SurfaceColumn lay_surfaces(const CellColumns& columns, int bands, int jump, std::size_t start,
                           SurfaceEntries& entries) {
    return HWY_DYNAMIC_DISPATCH(lay_column)(columns, bands, jump, start, entries);
}

SurfaceColumn lay_nothing(std::size_t start, SurfaceEntries& entries) {
    entries.smooth[start] = kSurfaceNothing;
    return {};
}

}  // namespace rs::engine
#endif  // HWY_ONCE
