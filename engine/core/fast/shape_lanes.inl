// The arithmetic of shape_walk.cpp on vectors, once for every SIMD target. Vectors hold a pixel per 32-bit lane
// ("lanes"), or, in four of them, the four channels of a pixel side by side: block b (16 bytes) of channel vector k
// belongs to lane 4 b + k ("channels"). No operation crosses a block.
//
// No include guard: cell_march_lanes.inl, which shape_walk.cpp includes, includes it once for each target.

#include "engine/core/definition/fixed_point.hpp"
#include "engine/core/fast/column_walk.hpp"

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace rs::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<std::int32_t, kStripColumns>;
using Vector = hn::Vec<Lanes>;
using LaneMask = hn::Mask<Lanes>;
using Wide = hn::Repartition<std::int64_t, Lanes>;
using WideBits = hn::Repartition<std::uint64_t, Lanes>;
using Halves = hn::Repartition<std::int16_t, Lanes>;
using Bytes = hn::Repartition<std::uint8_t, Lanes>;
using Floats = hn::Repartition<float, Lanes>;
using WideVector = hn::Vec<Wide>;

HWY_INLINE Vector number(std::int32_t value) {
    return hn::Set(Lanes(), value);
}

// a >= b
HWY_INLINE LaneMask at_least(Vector a, Vector b) {
    return hn::Not(hn::Lt(a, b));
}

// The odd lanes in place of the even ones.
HWY_INLINE Vector odd_lanes(Vector v) {
    return hn::BitCast(Lanes(), hn::ShiftRight<32>(hn::BitCast(WideBits(), v)));
}

struct Products {
    WideVector even;
    WideVector odd;
};

HWY_INLINE Products products(Vector a, Vector b) {
    return {hn::MulEven(a, b), hn::MulEven(odd_lanes(a), odd_lanes(b))};
}

// The lower 32 bits of the products shifted right.
template <int kShift>
HWY_INLINE Vector shifted(const Products& p) {
    const WideBits wide;
    return hn::OddEven(hn::BitCast(Lanes(), hn::ShiftLeft<32 - kShift>(hn::BitCast(wide, p.odd))),
                       hn::BitCast(Lanes(), hn::ShiftRight<kShift>(hn::BitCast(wide, p.even))));
}

// multiply_shift() where the ranges of engine/RECONSTRUCTION.md rule saturation out.
template <int kShift>
HWY_INLINE Vector multiply_shift_within(Vector a, Vector b) {
    return shifted<kShift>(products(a, b));
}

// multiply_shift(): whether it saturates shows in the upper halves of the products.
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

// floor(2^40 / l) for l in 2^17 .. 2^30; anything else gives any number. A float quotient is at most one away; the
// remainder, of which 32 bits suffice, says which way.
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

// Rearranges the bytes of every block; 0x80 gives 0.
HWY_INLINE Vector rearranged(Vector v, const std::uint8_t (&order)[16]) {
    const Bytes bytes;
    return hn::BitCast(Lanes(), hn::TableLookupBytesOr0(hn::BitCast(bytes, v), hn::LoadDup128(bytes, order)));
}

struct Channels {
    Vector of[4];
};

// f(n, vector to be broadcast) over the four channel vectors.
template <class F>
HWY_INLINE Channels for_channels(Vector lanes, const F& f) {
    return {{f(0, hn::Broadcast<0>(lanes)), f(1, hn::Broadcast<1>(lanes)), f(2, hn::Broadcast<2>(lanes)),
             f(3, hn::Broadcast<3>(lanes))}};
}

// Four texels of each lane, RGBA: upper left, lower left, upper right, lower right. Block b of vector k has those of
// lane 4 b + k.
struct TexelQuads {
    Vector of[4];
};

// 64 bits each from left and right + index[0], index[4], ... Plain loads: faster than a gather instruction, several of
// which would be busy with the same few cache lines.
template <std::size_t kBlocks>
HWY_INLINE hn::Vec<hn::FixedTag<std::int64_t, 2 * kBlocks>> every_fourth(const std::int32_t* left,
                                                                         const std::int32_t* right,
                                                                         const std::int32_t* index) {
    const hn::FixedTag<std::int64_t, 2 * kBlocks> all;
    if constexpr (kBlocks == 1) {
        const auto at = [&](const std::int32_t* base) {
            return hn::LoadU(hn::FixedTag<std::int64_t, 1>(), reinterpret_cast<const std::int64_t*>(base + *index));
        };
        return hn::Combine(all, at(right), at(left));
    } else {
        return hn::Combine(all, every_fourth<kBlocks / 2>(left, right, index + 2 * kBlocks),
                           every_fourth<kBlocks / 2>(left, right, index));
    }
}

// The upper left texel of each lane at base + index.
HWY_INLINE TexelQuads fetch(const std::int32_t* base, std::int32_t column_stride, const std::int32_t* index) {
    constexpr std::size_t kBlocks = hn::MaxLanes(Lanes()) / 4;
    TexelQuads quads;
    for (int k = 0; k < 4; ++k) {
        quads.of[k] = hn::BitCast(Lanes(), every_fourth<kBlocks>(base, base + column_stride, index + k));
    }
    return quads;
}

HWY_INLINE Vector all_bits(const TexelQuads& quads) {
    return hn::And(hn::And(quads.of[0], quads.of[1]), hn::And(quads.of[2], quads.of[3]));
}

// The weights of a lane's upper two texels and of its lower two, left and right in 16 bits each.
struct TexelWeights {
    Vector upper;
    Vector lower;
};

// Of a place `x`, `y` eighths from the upper left texel: 64 together.
HWY_INLINE TexelWeights texel_weights(Vector x, Vector y) {
    const Vector across = hn::Add(number(8), hn::Sub(hn::ShiftLeft<16>(x), x));
    const Vector lower = multiply_halves(across, hn::Or(y, hn::ShiftLeft<16>(y)));
    return {hn::Sub(hn::ShiftLeft<3>(across), lower), lower};
}

alignas(16) static constexpr std::uint8_t kUpperTexels[16] = {0, 0x80, 8,  0x80, 1, 0x80, 9,  0x80,
                                                              2, 0x80, 10, 0x80, 3, 0x80, 11, 0x80};
alignas(16) static constexpr std::uint8_t kLowerTexels[16] = {4, 0x80, 12, 0x80, 5, 0x80, 13, 0x80,
                                                              6, 0x80, 14, 0x80, 7, 0x80, 15, 0x80};

// Adds weight * (R, G, B, A).
HWY_INLINE void add_texels(const TexelQuads& quads, const TexelWeights& weights, Channels& sum) {
    const Channels upper = for_channels(weights.upper, [&](int n, Vector weight) {
        return multiply_pairs(rearranged(quads.of[n], kUpperTexels), weight);
    });
    const Channels lower = for_channels(weights.lower, [&](int n, Vector weight) {
        return multiply_pairs(rearranged(quads.of[n], kLowerTexels), weight);
    });
    for (int n = 0; n < 4; ++n) sum.of[n] = hn::Add(sum.of[n], hn::Add(upper.of[n], lower.of[n]));
}

// Sums of weight * alpha * (R, G, B, 1).
HWY_INLINE Channels premultiplied(const TexelQuads& quads, const TexelWeights& weights) {
    constexpr int o = 0x80;
    alignas(16) static constexpr std::uint8_t kUpperAlpha[16] = {3, o, 11, o, 3, o, 11, o, 3, o, 11, o, 3, o, 11, o};
    alignas(16) static constexpr std::uint8_t kLowerAlpha[16] = {7, o, 15, o, 7, o, 15, o, 7, o, 15, o, 7, o, 15, o};
    const auto sum = [&](const std::uint8_t(&texels)[16], const std::uint8_t(&alpha)[16], Vector of_weights) {
        return for_channels(of_weights, [&](int n, Vector weight) {
            const Vector one_for_alpha = hn::Or(hn::And(quads.of[n], number(0x00FFFFFF)), number(0x01000000));
            return multiply_pairs(rearranged(one_for_alpha, texels),
                                  multiply_halves(rearranged(quads.of[n], alpha), weight));
        });
    };
    Channels both = sum(kUpperTexels, kUpperAlpha, weights.upper);
    const Channels lower = sum(kLowerTexels, kLowerAlpha, weights.lower);
    for (int n = 0; n < 4; ++n) both.of[n] = hn::Add(both.of[n], lower.of[n]);
    return both;
}

// The fourth channel of each lane.
HWY_INLINE Vector fourth(const Channels& channels) {
    constexpr int o = 0x80;
    alignas(16) static constexpr std::uint8_t kTo0[16] = {12, 13, 14, 15, o, o, o, o, o, o, o, o, o, o, o, o};
    alignas(16) static constexpr std::uint8_t kTo1[16] = {o, o, o, o, 12, 13, 14, 15, o, o, o, o, o, o, o, o};
    alignas(16) static constexpr std::uint8_t kTo2[16] = {o, o, o, o, o, o, o, o, 12, 13, 14, 15, o, o, o, o};
    alignas(16) static constexpr std::uint8_t kTo3[16] = {o, o, o, o, o, o, o, o, o, o, o, o, 12, 13, 14, 15};
    return hn::Or(hn::Or(rearranged(channels.of[0], kTo0), rearranged(channels.of[1], kTo1)),
                  hn::Or(rearranged(channels.of[2], kTo2), rearranged(channels.of[3], kTo3)));
}

// The lowest byte of each channel, in memory order.
HWY_INLINE Vector packed(const Channels& channels) {
    constexpr int o = 0x80;
    alignas(16) static constexpr std::uint8_t kTo0[16] = {0, 4, 8, 12, o, o, o, o, o, o, o, o, o, o, o, o};
    alignas(16) static constexpr std::uint8_t kTo1[16] = {o, o, o, o, 0, 4, 8, 12, o, o, o, o, o, o, o, o};
    alignas(16) static constexpr std::uint8_t kTo2[16] = {o, o, o, o, o, o, o, o, 0, 4, 8, 12, o, o, o, o};
    alignas(16) static constexpr std::uint8_t kTo3[16] = {o, o, o, o, o, o, o, o, o, o, o, o, 0, 4, 8, 12};
    return hn::Or(hn::Or(rearranged(channels.of[0], kTo0), rearranged(channels.of[1], kTo1)),
                  hn::Or(rearranged(channels.of[2], kTo2), rearranged(channels.of[3], kTo3)));
}

// resolve() of shape_pixel.hpp, as RGBA in memory order. The float quotient is at most one too small.
HWY_INLINE Vector resolve_lanes(const Channels& sum, Vector a) {
    const Floats floats;
    const Vector divisor = hn::Max(a, number(1));
    const Vector alpha = hn::ShiftRight<14>(hn::Add(a, number(1 << 13)));
    const auto reciprocal = hn::BitCast(Lanes(), hn::Div(hn::Set(floats, 1.0F), hn::ConvertTo(floats, divisor)));
    const Channels divisors = for_channels(divisor, [](int, Vector v) { return v; });
    const Channels quotients = for_channels(reciprocal, [&](int n, Vector inverse_divisor) {
        const Vector by = divisors.of[n];
        const Vector dividend = hn::Add(sum.of[n], hn::ShiftRight<1>(by));
        const auto quotient =
            hn::MulSub(hn::ConvertTo(floats, dividend), hn::BitCast(floats, inverse_divisor), hn::Set(floats, 0x1p-9F));
        const Vector guess = hn::ConvertTo(Lanes(), quotient);
        const Vector rest = hn::Sub(dividend, hn::Mul(guess, by));
        return hn::Sub(guess, hn::VecFromMask(Lanes(), at_least(rest, by)));
    });
    const Vector colour = hn::And(packed(quotients), number(0x00FFFFFF));
    return hn::IfThenElseZero(hn::Gt(alpha, hn::Zero(Lanes())), hn::Or(colour, hn::ShiftLeft<24>(alpha)));
}

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
