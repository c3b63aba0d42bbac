// SIMD arithmetic of shape_walk.cpp. Vectors hold one pixel per 32-bit lane: consecutive rows of one view column.
//
// No include guard: cell_march_lanes.inl includes it once for each SIMD target.

#include "engine/core/definition/fixed_point.hpp"
#include "engine/core/definition/texel_detail.hpp"
#include "engine/core/fast/shape_walk.hpp"

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<std::int32_t, kBlockRows>;
using Vector = hn::Vec<Lanes>;
using LaneMask = hn::Mask<Lanes>;
using Wide = hn::Repartition<std::int64_t, Lanes>;
using WideBits = hn::Repartition<std::uint64_t, Lanes>;
using Halves = hn::Repartition<std::int16_t, Lanes>;
using HalfBits = hn::Repartition<std::uint16_t, Lanes>;
using Floats = hn::Repartition<float, Lanes>;
using WideVector = hn::Vec<Wide>;

HWY_INLINE Vector number(std::int32_t value) {
    return hn::Set(Lanes(), value);
}

// a >= b
HWY_INLINE LaneMask at_least(Vector a, Vector b) {
    return hn::Not(hn::Lt(a, b));
}

// Moves the odd lanes to the even ones.
HWY_INLINE Vector odd_lanes(Vector v) {
    return hn::BitCast(Lanes(), hn::ShiftRight<32>(hn::BitCast(WideBits(), v)));
}

struct Products {
    WideVector even;
    WideVector odd;
};

// Signed products of the even lanes.
HWY_INLINE WideVector multiply_even(Vector a, Vector b) {
#if HWY_TARGET == HWY_WASM
    // MulEven of Highway 1.0.3 extends signed lanes with zeros on this target.
    const auto even = [](Vector v) { return wasm_i32x4_shuffle(v.raw, v.raw, 0, 2, 0, 2); };
    return WideVector{wasm_i64x2_extmul_low_i32x4(even(a), even(b))};
#else
    return hn::MulEven(a, b);
#endif
}

HWY_INLINE Products products(Vector a, Vector b) {
    return {multiply_even(a, b), multiply_even(odd_lanes(a), odd_lanes(b))};
}

// Lower 32 bits of the products shifted right.
template <int kShift>
HWY_INLINE Vector shifted(const Products& p) {
    const WideBits wide;
    return hn::OddEven(hn::BitCast(Lanes(), hn::ShiftLeft<32 - kShift>(hn::BitCast(wide, p.odd))),
                       hn::BitCast(Lanes(), hn::ShiftRight<kShift>(hn::BitCast(wide, p.even))));
}

// multiply_shift() without saturation, for operands whose ranges in engine/RECONSTRUCTION.md exclude it.
template <int kShift>
HWY_INLINE Vector multiply_shift_within(Vector a, Vector b) {
    return shifted<kShift>(products(a, b));
}

// multiply_shift(); the upper halves of the products determine saturation.
template <int kShift>
HWY_INLINE Vector multiply_shift(Vector a, Vector b) {
    static_assert(kSaturated + 1 == 1 << 29);
    constexpr std::int32_t kLimit = 1 << (29 + kShift - 32);
    const Products p = products(a, b);
    const Vector upper = hn::OddEven(hn::BitCast(Lanes(), p.odd), odd_lanes(hn::BitCast(Lanes(), p.even)));
    const Vector low = shifted<kShift>(p);
    const Vector capped = hn::IfThenElse(hn::Gt(upper, number(kLimit - 1)), number(kSaturated), low);
    return hn::IfThenElse(hn::Lt(upper, number(-kLimit)), number(-kSaturated - 1), capped);
}

// floor(2^40 / l) for l in 2^17 .. 2^30, undefined for other l. The float quotient is off by at most one and is
// corrected by the remainder, for which 32 bits suffice.
HWY_INLINE Vector inverse(Vector l) {
    const Floats floats;
    const Vector guess = hn::ConvertTo(Lanes(), hn::Div(hn::Set(floats, 0x1p40F), hn::ConvertTo(floats, l)));
    const Vector rest = hn::Sub(hn::Zero(Lanes()), hn::Mul(guess, l));  // 2^40 is 0 modulo 2^32
    const Vector up = hn::Sub(guess, hn::VecFromMask(Lanes(), at_least(rest, l)));
    return hn::Add(up, hn::VecFromMask(Lanes(), hn::Lt(rest, hn::Zero(Lanes()))));
}

// a[2 n] * b[2 n] + a[2 n + 1] * b[2 n + 1] of 16-bit numbers.
HWY_INLINE Vector multiply_pairs(Vector a, Vector b) {
    Vector odd = hn::Zero(Lanes());
    const Vector even = hn::ReorderWidenMulAccumulate(Lanes(), hn::BitCast(Halves(), a), hn::BitCast(Halves(), b),
                                                      hn::Zero(Lanes()), odd);
    return hn::RearrangeToOddPlusEven(even, odd);
}

HWY_INLINE Vector multiply_halves(Vector a, Vector b) {
    return hn::BitCast(Lanes(), hn::Mul(hn::BitCast(Halves(), a), hn::BitCast(Halves(), b)));
}

inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(Lanes()));

// Lanes with a valid lane index, 0 .. kLanes - 1.
HWY_INLINE LaneMask is_lane(Vector v) {
    return hn::Eq(hn::And(v, number(-kLanes)), hn::Zero(Lanes()));
}

// table[index], 0 <= index. The rows of a column mostly read neighbouring entries, which one load covers. kLanes
// numbers after the largest index must be readable.
HWY_INLINE Vector look_up(const std::int32_t* table, Vector index) {
    // Lower rows of the view mostly read lower bands.
    const std::int32_t begin = std::max(hn::GetLane(index) - (kLanes - kLanes / 4 - 1), 0);
    const Vector offset = hn::Sub(index, number(begin));
    if (HWY_LIKELY(hn::AllTrue(Lanes(), is_lane(offset)))) {
        return hn::TableLookupLanes(hn::LoadU(Lanes(), table + begin), hn::IndicesFromVec(Lanes(), offset));
    }
    return hn::GatherIndex(Lanes(), table, index);
}

// 2x2 texels of each lane, RGBA, and their details: left and right in 16 bits each.
struct TexelQuads {
    Vector upper_left;
    Vector lower_left;
    Vector upper_right;
    Vector lower_right;
    Vector upper_detail;
    Vector lower_detail;
};

// Memory layout of the images' texels (texel_store.hpp).
struct TexelGrid {
    const std::int32_t* texels;
    const std::int8_t* details;  // null with the bilinear filter
    std::int32_t column_stride;
    std::int32_t height;
};

// Combines the odd 16-bit halves of one vector with the even halves of another.
HWY_INLINE Vector odd_and_even_halves(Vector odd, Vector even) {
    return hn::BitCast(Lanes(), hn::OddEven(hn::BitCast(HalfBits(), odd), hn::BitCast(HalfBits(), even)));
}

// Packs the lower 16 bits of the lanes of two vectors.
HWY_INLINE Vector left_and_right(Vector left, Vector right) {
    return odd_and_even_halves(hn::ShiftLeft<16>(right), left);
}

// Loads the 2x2 texels at positions x, y of an image, in eighths of a texel from texel (0, 0), whose index is `start`;
// zero in lanes that are not `requested`. The rows of a view column sample the image downwards, so that a few windows
// of kLanes + 1 texels of a column cover all lanes.
HWY_INLINE TexelQuads fetch(const TexelGrid& grid, std::int32_t start, Vector x_q3, Vector y_q3, LaneMask requested) {
    alignas(64) std::int32_t columns[kBlockRows];
    alignas(64) std::int32_t rows[kBlockRows];
    const Vector in_columns =
        hn::IfThenElseZero(requested, hn::Mul(hn::ShiftRight<3>(x_q3), number(grid.column_stride)));
    const Vector in_rows = hn::IfThenElseZero(requested, hn::ShiftRight<3>(y_q3));
    hn::Store(in_columns, Lanes(), columns);
    hn::Store(in_rows, Lanes(), rows);
    const Vector index = hn::Add(in_columns, in_rows);
    const Vector zero = hn::Zero(Lanes());
    TexelQuads quads{zero, zero, zero, zero, zero, zero};
    // Prefetches the texels of the next rows of this column, which are read after all other columns. (The
    // compiler drops prefetches in a lambda.)
    constexpr int kBefore = 14;  // of 16 in a cache line
    const std::int32_t below = std::clamp(2 * rows[kLanes - 1] - rows[0], kBefore, std::max(grid.height - 1, kBefore));
    const std::int32_t* const next = grid.texels + start + columns[kLanes - 1] + below;
    for (const std::int32_t* const texel : {next, next + grid.column_stride}) {
        hwy::Prefetch(texel);
        hwy::Prefetch(texel - kBefore);
    }
    while (!hn::AllFalse(Lanes(), requested)) {
        const auto lane = hn::FindFirstTrue(Lanes(), requested);
        // A lower row of the view may sample slightly higher in the image.
        const std::int32_t top = std::max(std::min(rows[lane] - kLanes / 8, grid.height - kLanes), -1);
        const std::int32_t begin = columns[lane] + top;
        const std::int32_t* const left = grid.texels + start + begin;
        const std::int32_t* const right = left + grid.column_stride;
        const Vector offset = hn::Sub(index, number(begin));
        const LaneMask inside = hn::And(requested, is_lane(offset));
        const auto order = hn::IndicesFromVec(Lanes(), hn::And(offset, number(kLanes - 1)));
        const auto load = [&](const std::int32_t* from, Vector& to) {
            to = hn::IfThenElse(inside, hn::TableLookupLanes(hn::LoadU(Lanes(), from), order), to);
        };
        load(left, quads.upper_left);
        load(left + 1, quads.lower_left);
        load(right, quads.upper_right);
        load(right + 1, quads.lower_right);
        if (grid.details != nullptr) {
            const hn::Rebind<std::int8_t, Lanes> bytes;
            const std::int8_t* const left_details = grid.details + start + begin;
            const std::int8_t* const right_details = left_details + grid.column_stride;
            const auto load_details = [&](std::ptrdiff_t row, Vector& to) {
                const Vector pairs = left_and_right(hn::PromoteTo(Lanes(), hn::LoadU(bytes, left_details + row)),
                                                    hn::PromoteTo(Lanes(), hn::LoadU(bytes, right_details + row)));
                to = hn::IfThenElse(inside, hn::TableLookupLanes(pairs, order), to);
            };
            load_details(0, quads.upper_detail);
            load_details(1, quads.lower_detail);
        }
        requested = hn::AndNot(inside, requested);
    }
    return quads;
}

HWY_INLINE Vector all_bits(const TexelQuads& quads) {
    return hn::And(hn::And(quads.upper_left, quads.lower_left), hn::And(quads.upper_right, quads.lower_right));
}

// Weights of a lane's upper and lower texels: left and right in 16 bits each.
struct TexelWeights {
    Vector upper;
    Vector lower;
};

// Bilinear weights at x, y eighths from the upper left texel; they add up to 64.
HWY_INLINE TexelWeights texel_weights(Vector x, Vector y) {
    const Vector across = hn::Add(number(8), hn::Sub(hn::ShiftLeft<16>(x), x));
    const Vector lower = multiply_halves(across, hn::Or(y, hn::ShiftLeft<16>(y)));
    return {hn::Sub(hn::ShiftLeft<3>(across), lower), lower};
}

// Channels of two texels: left and right in 16 bits each.
struct TexelPair {
    Vector r, g, b, a;
};

HWY_INLINE TexelPair texel_pair(Vector left, Vector right) {
    const auto first = [](Vector v) { return hn::And(v, number(0x00FF00FF)); };
    const auto second = [](Vector v) { return hn::BitCast(Lanes(), hn::ShiftRight<8>(hn::BitCast(HalfBits(), v))); };
    const Vector red_green = left_and_right(left, right);
    const Vector blue_alpha = odd_and_even_halves(
        right, hn::BitCast(Lanes(), hn::ShiftRight<16>(hn::BitCast(hn::RebindToUnsigned<Lanes>(), left))));
    return {first(red_green), second(red_green), first(blue_alpha), second(blue_alpha)};
}

struct Channels {
    Vector r, g, b, a;
};

// sample_detail() without alpha, at x, y eighths between the texels; colour codes, q6.
HWY_INLINE Vector detail_codes(TexelFilter filter, const TexelQuads& quads, const TexelWeights& weights, Vector x,
                               Vector y) {
    const Vector eight = number(8);
    const Vector strength = filter == TexelFilter::kSmooth
                                ? number(-kSmoothing)
                                : hn::Add(hn::Mul(x, hn::Sub(eight, x)), hn::Mul(y, hn::Sub(eight, y)));
    const Vector sum =
        hn::Add(multiply_pairs(quads.upper_detail, weights.upper), multiply_pairs(quads.lower_detail, weights.lower));
    return hn::ShiftRight<6>(hn::Mul(strength, sum));
}

// Adds weight * (R, G, B) to `sum`.
HWY_INLINE void add_texels(const TexelQuads& quads, const TexelWeights& weights, Channels& sum) {
    const auto add = [&](Vector left, Vector right, Vector weight) {
        const TexelPair texels = texel_pair(left, right);
        sum.r = hn::Add(sum.r, multiply_pairs(texels.r, weight));
        sum.g = hn::Add(sum.g, multiply_pairs(texels.g, weight));
        sum.b = hn::Add(sum.b, multiply_pairs(texels.b, weight));
    };
    add(quads.upper_left, quads.upper_right, weights.upper);
    add(quads.lower_left, quads.lower_right, weights.lower);
}

// Sums of weight * alpha * (R, G, B, 1).
HWY_INLINE Channels premultiplied(const TexelQuads& quads, const TexelWeights& weights) {
    const Vector zero = hn::Zero(Lanes());
    Channels sum{zero, zero, zero, zero};
    const auto add = [&](Vector left, Vector right, Vector weight) {
        const TexelPair texels = texel_pair(left, right);
        const Vector part = multiply_halves(texels.a, weight);
        sum.r = hn::Add(sum.r, multiply_pairs(texels.r, part));
        sum.g = hn::Add(sum.g, multiply_pairs(texels.g, part));
        sum.b = hn::Add(sum.b, multiply_pairs(texels.b, part));
        sum.a = hn::Add(sum.a, multiply_pairs(texels.a, weight));
    };
    add(quads.upper_left, quads.upper_right, weights.upper);
    add(quads.lower_left, quads.lower_right, weights.lower);
    return sum;
}

// Packs channels 0 .. 255 as RGBA in memory order.
HWY_INLINE Vector packed(Vector r, Vector g, Vector b, Vector a) {
    return hn::Or(hn::Or(r, hn::ShiftLeft<8>(g)), hn::Or(hn::ShiftLeft<16>(b), hn::ShiftLeft<24>(a)));
}

// resolve() of shape_pixel.hpp, as RGBA in memory order. The float quotient is at most one too small and is corrected.
HWY_INLINE Vector resolve_lanes(const Channels& sum, Vector detail) {
    const Floats floats;
    const Vector divisor = hn::Max(sum.a, number(1));
    const Vector half = hn::ShiftRight<1>(divisor);
    const Vector alpha = hn::ShiftRight<14>(hn::Add(sum.a, number(1 << 13)));
    const auto reciprocal = hn::Div(hn::Set(floats, 1.0F), hn::ConvertTo(floats, divisor));
    const Vector most = hn::Sub(hn::ShiftLeft<8>(divisor), divisor);
    const auto channel = [&](Vector c) {
        const Vector filtered = hn::Min(hn::Max(hn::Add(c, detail), hn::Zero(Lanes())), most);
        const Vector dividend = hn::Add(filtered, half);
        const auto quotient = hn::MulSub(hn::ConvertTo(floats, dividend), reciprocal, hn::Set(floats, 0x1p-9F));
        const Vector guess = hn::ConvertTo(Lanes(), quotient);
        const Vector rest = hn::Sub(dividend, hn::Mul(guess, divisor));
        return hn::Sub(guess, hn::VecFromMask(Lanes(), at_least(rest, divisor)));
    };
    return hn::IfThenElseZero(hn::Gt(alpha, hn::Zero(Lanes())),
                              packed(channel(sum.r), channel(sum.g), channel(sum.b), alpha));
}

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
