#include "engine/core/fast/surface_column.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/core/fast/surface_column.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Halves = hn::CappedTag<std::int16_t, kSurfaceLanes>;
using Half = hn::Vec<Halves>;

HWY_INLINE Half half(int value) {
    return hn::Set(Halves(), static_cast<std::int16_t>(value));
}

struct SurfaceHalves {
    Half depth_q3;  // -1: no surface
    Half lean;
    Half deepest;  // of both lines, whole steps; -1: neither has a surface
    Half lacking;  // -1 if either line has no surface
};

// between_lines() of one vector of bands.
HWY_INLINE SurfaceHalves between_lines(const ShapeCell* first_cells, const ShapeCell* second_cells, int part,
                                       int jump) {
    const Half zero = hn::Zero(Halves());
    const Half first = hn::LoadU(Halves(), reinterpret_cast<const std::int16_t*>(first_cells));
    const Half second = hn::LoadU(Halves(), reinterpret_cast<const std::int16_t*>(second_cells));
    const auto depth_of = [](Half cell) { return hn::And(cell, half(255)); };
    const auto shown_of = [](Half cell) { return hn::ShiftRight<8>(cell); };
    const auto has_first = hn::Gt(shown_of(first), zero);
    const auto has_second = hn::Gt(part > 0 ? shown_of(second) : zero, zero);
    const Half first_q3 = hn::ShiftLeft<3>(depth_of(first));
    const Half second_q3 = hn::ShiftLeft<3>(depth_of(second));
    const Half apart = hn::Sub(depth_of(second), depth_of(first));
    const auto jumps = hn::Gt(hn::Abs(apart), half(jump));
    // Selects the value of either line, or their interpolation `mean`.
    const auto between = [&](Half of_first, Half of_second, Half mean, Half nothing) {
        const Half both = hn::IfThenElse(jumps, part < 4 ? of_first : of_second, mean);
        return hn::IfThenElse(has_first, hn::IfThenElse(has_second, both, of_first),
                              hn::IfThenElse(has_second, of_second, nothing));
    };
    const auto lean_of = [&](Half cell) {  // lean_of() of shape_cells.hpp
        const Half shown = shown_of(cell);
        const Half leans = hn::Sub(hn::IfThenElseZero(hn::Eq(shown, half(ShapeCell::kBySecond)), half(1)),
                                   hn::IfThenElseZero(hn::Eq(shown, half(ShapeCell::kByFirst)), half(1)));
        return hn::Add(half(1), leans);
    };
    const Half first_lean = hn::ShiftLeft<3>(lean_of(first));
    const Half more_lean = hn::Sub(lean_of(second), lean_of(first));
    const auto deepest_of = [&](Half cell) {
        return hn::IfThenElse(hn::Gt(shown_of(cell), zero), depth_of(cell), half(-1));
    };
    const Half least_shown = hn::Min(shown_of(first), shown_of(second));
    return {between(first_q3, second_q3, hn::Add(first_q3, hn::Mul(apart, half(part))), half(-1)),
            between(first_lean, hn::ShiftLeft<3>(lean_of(second)), hn::Add(first_lean, hn::Mul(more_lean, half(part))),
                    half(kBothShow)),
            hn::Max(deepest_of(first), deepest_of(second)), hn::IfThenElseZero(hn::Eq(least_shown, zero), half(-1))};
}

// Bands of one of the two columns along p, padded with bands without a surface at both ends.
struct BandHalves {
    std::vector<std::int16_t> depth_q3;
    std::vector<std::int16_t> lean;
    std::vector<std::int16_t> deepest;
    std::vector<std::int16_t> lacking;
};

void fill_bands(const ShapeCell* first, const ShapeCell* second, int bands, int part, int jump, int margin,
                BandHalves& out) {
    const int lanes = static_cast<int>(hn::Lanes(Halves()));
    const auto length = static_cast<std::size_t>(bands + 2 * margin + lanes);
    out.depth_q3.assign(length, -1);
    out.lean.assign(length, kBothShow);
    out.deepest.assign(length, -1);
    out.lacking.assign(length, -1);
    const int rest_count = bands % lanes;
    int band = 0;
    const auto store = [&](const ShapeCell* f, const ShapeCell* s) {
        const SurfaceHalves surfaces = between_lines(f, s, part, jump);
        hn::StoreU(surfaces.depth_q3, Halves(), out.depth_q3.data() + margin + band);
        hn::StoreU(surfaces.lean, Halves(), out.lean.data() + margin + band);
        hn::StoreU(surfaces.deepest, Halves(), out.deepest.data() + margin + band);
        hn::StoreU(surfaces.lacking, Halves(), out.lacking.data() + margin + band);
    };
    for (; band < bands - rest_count; band += lanes) store(first + band, second + band);
    if (rest_count == 0) return;
    // Cells after the last band belong to another column or are out of range.
    ShapeCell rest[2][kSurfaceLanes] = {};
    std::copy_n(first + band, rest_count, rest[0]);
    std::copy_n(second + band, rest_count, rest[1]);
    store(rest[0], rest[1]);
}

// surfaces_between() at all kSurfaceParts positions between two bands, for cells on different surfaces or with a lean.
void fill_steps(const int (&depth)[2][2], const int (&lean)[2][2], int p_part, int jump, std::int32_t* out) {
    int nearest = 1 << 12;
    int farthest = -1;
    for (const auto& column : depth) {
        for (const int d : column) {
            if (d >= 0) nearest = std::min(nearest, d);
            farthest = std::max(farthest, d);
        }
    }
    int weight[2][2] = {};  // [nearer or farther group][band]
    int sum[2][2] = {};
    int leans[2][2] = {};
    for (int p = 0; p < 2; ++p) {
        for (int h = 0; h < 2; ++h) {
            const int d = depth[p][h];
            if (d < 0) continue;
            const int group = farthest - nearest > 8 * jump && 2 * d > nearest + farthest ? 1 : 0;
            const int part = p == 0 ? 8 - p_part : p_part;
            weight[group][h] += part;
            sum[group][h] += part * d;
            leans[group][h] += part * lean[p][h];
        }
    }
    using Parts = hn::CappedTag<std::int32_t, kSurfaceParts>;
    const Parts parts;
    const hn::Repartition<float, Parts> floats;
    for (int from = 0; from < static_cast<int>(kSurfaceParts); from += static_cast<int>(hn::Lanes(parts))) {
        const auto upper = hn::Iota(parts, from);
        const auto lower = hn::Sub(hn::Set(parts, 8), upper);
        const auto between = [&](const int(&bands)[2]) {
            return hn::Add(hn::Mul(lower, hn::Set(parts, bands[0])), hn::Mul(upper, hn::Set(parts, bands[1])));
        };
        // Dividends below 2^18 and divisors of at most 64: truncating the float quotient is exact.
        const auto mean = [&](auto weights, auto sums) {
            const auto dividend = hn::ConvertTo(floats, hn::Add(sums, hn::ShiftRight<1>(weights)));
            const auto divisor = hn::ConvertTo(floats, hn::Max(weights, hn::Set(parts, 1)));
            return hn::ConvertTo(parts, hn::Div(dividend, divisor));
        };
        const auto nothing = hn::Set(parts, kNoSurface);
        const auto surface = [&](auto weights, int group) {
            const auto depths = mean(weights, between(sum[group]));
            const auto of_leans = mean(weights, between(leans[group]));
            return hn::IfThenElse(hn::Gt(weights, hn::Zero(parts)), hn::Or(depths, hn::ShiftLeft<kDepthBits>(of_leans)),
                                  nothing);
        };
        const auto near_weight = between(weight[0]);
        const auto far_weight = between(weight[1]);
        const auto far = surface(far_weight, 1);
        const auto far_first = hn::Lt(near_weight, far_weight);
        const auto first = hn::IfThenElse(far_first, far, surface(near_weight, 0));
        const auto behind = hn::IfThenElse(far_first, nothing, far);
        hn::StoreU(hn::Or(first, hn::ShiftLeft<16>(behind)), parts, out + from);
    }
}

SurfaceColumn build_column(const CellColumns& columns, const ShapeMap& shape, std::size_t start,
                           SurfaceEntries& entries) {
    constexpr int kMargin = 2;
    const int bands = shape.bands;
    const int jump = shape.jump;
    static thread_local BandHalves of_p[2];
    for (int p = 0; p < 2; ++p) {
        fill_bands(columns.at[p][0], columns.at[p][1], bands, columns.line_part, jump, kMargin, of_p[p]);
    }
    const auto are_empty = [&](int band, auto depths) {  // tests sizeof depths / 2 bands
        decltype(depths) both[2];
        for (std::size_t p = 0; p < 2; ++p) {
            std::memcpy(&both[p], of_p[p].depth_q3.data() + band + kMargin, sizeof depths);
        }
        return (both[0] & both[1]) == -1;
    };
    using One = std::int16_t;
    using Four = std::int64_t;
    int low = 0;
    int high = bands;
    while (low + 4 <= bands && are_empty(low, Four{})) low += 4;
    while (low < bands && are_empty(low, One{})) ++low;
    if (low == bands) return build_empty_column(start, entries);
    while (high >= low + 4 && are_empty(high - 4, Four{})) high -= 4;
    while (are_empty(high - 1, One{})) --high;

    SurfaceColumn column;
    column.first_band = low - 2;
    column.last = high - low + 2;
    const int lanes = static_cast<int>(hn::Lanes(Halves()));
    const Halves halves;
    const Half zero = hn::Zero(halves);
    std::size_t step = 0;
    Half nearest = half(8 * 256);
    Half deepest_of_all = half(-1);
    for (int n = 0; n <= column.last; n += lanes) {
        const auto from = static_cast<std::size_t>(low + n);  // first_band + n + kMargin
        Half depth[2][2];                                     // [p][band]
        Half low_sum[2];
        Half deepest = half(-1);
        Half lacking = zero;  // -1 if any of the eight cells has no surface
        Half leans = zero;    // not 0 if any lean differs from kBothShow
        for (std::size_t b = 0; b < 2; ++b) {
            for (std::size_t p = 0; p < 2; ++p) {
                depth[p][b] = hn::LoadU(halves, of_p[p].depth_q3.data() + from + b);
                deepest = hn::Max(deepest, hn::LoadU(halves, of_p[p].deepest.data() + from + b));
                lacking = hn::Or(lacking, hn::LoadU(halves, of_p[p].lacking.data() + from + b));
                leans = hn::Or(leans, hn::Xor(hn::LoadU(halves, of_p[p].lean.data() + from + b), half(kBothShow)));
            }
            low_sum[b] =
                hn::Add(hn::Mul(depth[0][b], half(8 - columns.p_part)), hn::Mul(depth[1][b], half(columns.p_part)));
        }
        const Half least = hn::Min(hn::Min(depth[0][0], depth[0][1]), hn::Min(depth[1][0], depth[1][1]));
        const Half most = hn::Max(hn::Max(depth[0][0], depth[0][1]), hn::Max(depth[1][0], depth[1][1]));
        const auto are_one = hn::AndNot(hn::Lt(least, zero), hn::Not(hn::Gt(hn::Sub(most, least), half(8 * jump))));
        const auto is_smooth = hn::And(are_one, hn::Eq(leans, zero));
        const Half otherwise = hn::IfThenElse(
            hn::Lt(most, zero), half(static_cast<std::int16_t>(kSurfaceNothing - (1 << 16))), half(kSurfaceSteps));
        const Half lower = hn::IfThenElse(is_smooth, low_sum[0], otherwise);
        const Half upper = hn::IfThenElseZero(is_smooth, hn::Sub(low_sum[1], low_sum[0]));
        const std::size_t to = start + static_cast<std::size_t>(n);
        hn::StoreInterleaved2(lower, upper, halves, reinterpret_cast<std::int16_t*>(entries.smooth.data() + to));
        hn::StoreInterleaved2(deepest, lacking, halves, reinterpret_cast<std::int16_t*>(entries.deepest.data() + to));
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(halves, hn::Eq(lower, half(kSurfaceSteps)), bits);
        std::uint64_t stepping = 0;
        std::memcpy(&stepping, bits, sizeof stepping);
        for (; stepping != 0; stepping &= stepping - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(stepping));
            const std::size_t at = from + lane;
            const int around[2][2] = {{of_p[0].depth_q3[at], of_p[0].depth_q3[at + 1]},
                                      {of_p[1].depth_q3[at], of_p[1].depth_q3[at + 1]}};
            const int lean[2][2] = {{of_p[0].lean[at], of_p[0].lean[at + 1]}, {of_p[1].lean[at], of_p[1].lean[at + 1]}};
            fill_steps(around, lean, columns.p_part, jump,
                       entries.steps.data() + kSurfaceParts * start + kSurfaceParts * step);
            entries.smooth[to + lane] = (1 << 16) + kSurfaceSteps + static_cast<std::int32_t>(step++);
        }
        for (const auto& both_bands : depth) {
            for (const Half d : both_bands) nearest = hn::Min(nearest, hn::IfThenElse(hn::Lt(d, zero), nearest, d));
        }
        deepest_of_all = hn::Max(deepest_of_all, deepest);
    }
    column.nearest = hn::GetLane(hn::MinOfLanes(halves, nearest)) >> 3;
    column.beyond = std::min(hn::GetLane(hn::MaxOfLanes(halves, deepest_of_all)) + shape.thickness + 1, 256);
    return column;
}

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::engine {

HWY_EXPORT(build_column);

SurfaceColumn build_surface_column(const CellColumns& columns, const ShapeMap& shape, std::size_t start,
                                   SurfaceEntries& entries) {
    return HWY_DYNAMIC_DISPATCH(build_column)(columns, shape, start, entries);
}

SurfaceColumn build_empty_column(std::size_t start, SurfaceEntries& entries) {
    entries.smooth[start] = kSurfaceNothing;
    return {};
}

}  // namespace rs::engine
#endif  // HWY_ONCE
