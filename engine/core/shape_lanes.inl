// The arithmetic of shape_walk.cpp on vectors, once for every SIMD target. Vectors hold a pixel per 32-bit lane
// ("lanes"), or, in four of them, the four channels of a pixel side by side: block b (16 bytes) of channel vector k
// belongs to lane 4 b + k ("channels"). No operation crosses a block.
//
// No include guard: cell_march_lanes.inl, which shape_walk.cpp includes, includes it once for each target.

#include "engine/core/column_walk.hpp"
#include "engine/core/fixed_point.hpp"

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

// 64 bits each from base + index[0], base + index[2], ... Plain loads: faster than a gather instruction, several of
// which would be busy with the same few cache lines.
template <std::size_t kCount>
HWY_INLINE hn::Vec<hn::FixedTag<std::int64_t, kCount>> every_second(const std::int32_t* base,
                                                                    const std::int32_t* index) {
    if constexpr (kCount == 1) {
        return hn::LoadU(hn::FixedTag<std::int64_t, 1>(), reinterpret_cast<const std::int64_t*>(base + *index));
    } else {
        return hn::Combine(hn::FixedTag<std::int64_t, kCount>(), every_second<kCount / 2>(base, index + kCount),
                           every_second<kCount / 2>(base, index));
    }
}

// Two texels of each lane, one below the other, the upper one at base + index: of the even lanes and of the odd ones.
struct TexelPairs {
    Vector even;
    Vector odd;
};

HWY_INLINE TexelPairs fetch(const std::int32_t* base, const std::int32_t* index) {
    constexpr std::size_t kPairs = hn::MaxLanes(Wide());
    return {hn::BitCast(Lanes(), every_second<kPairs>(base, index)),
            hn::BitCast(Lanes(), every_second<kPairs>(base, index + 1))};
}

// Weight times alpha of two texels of each lane, as 16-bit halves.
HWY_INLINE Vector weighted_alpha(const TexelPairs& texels, Vector weights) {
    constexpr int o = 0x80;
    alignas(16) static constexpr std::uint8_t kOfEven[16] = {3, o, 7, o, o, o, o, o, 11, o, 15, o, o, o, o, o};
    alignas(16) static constexpr std::uint8_t kOfOdd[16] = {o, o, o, o, 3, o, 7, o, o, o, o, o, 11, o, 15, o};
    return multiply_halves(hn::Or(rearranged(texels.even, kOfEven), rearranged(texels.odd, kOfOdd)), weights);
}

// Adds weighted_alpha * (R, G, B, 1) of two texels of each lane.
HWY_INLINE void add_weighted(const TexelPairs& texels, Vector weighted_alpha, Channels& sum) {
    constexpr int o = 0x80;
    alignas(16) static constexpr std::uint8_t kLower[16] = {0, o, 4, o, 1, o, 5, o, 2, o, 6, o, 3, o, 7, o};
    alignas(16) static constexpr std::uint8_t kUpper[16] = {8, o, 12, o, 9, o, 13, o, 10, o, 14, o, 11, o, 15, o};
    const auto one_for_alpha = [](Vector v) { return hn::Or(hn::And(v, number(0x00FFFFFF)), number(0x01000000)); };
    const Vector even = one_for_alpha(texels.even);
    const Vector odd = one_for_alpha(texels.odd);
    const auto add = [](Vector& to, Vector colours, Vector weights) {
        to = hn::Add(to, multiply_pairs(colours, weights));
    };
    add(sum.of[0], rearranged(even, kLower), hn::Broadcast<0>(weighted_alpha));
    add(sum.of[1], rearranged(odd, kLower), hn::Broadcast<1>(weighted_alpha));
    add(sum.of[2], rearranged(even, kUpper), hn::Broadcast<2>(weighted_alpha));
    add(sum.of[3], rearranged(odd, kUpper), hn::Broadcast<3>(weighted_alpha));
}

// f(n, vector to be broadcast) over the four channel vectors.
template <class F>
HWY_INLINE Channels for_channels(Vector lanes, const F& f) {
    return {{f(0, hn::Broadcast<0>(lanes)), f(1, hn::Broadcast<1>(lanes)), f(2, hn::Broadcast<2>(lanes)),
             f(3, hn::Broadcast<3>(lanes))}};
}

// The sum of the four channels of each lane.
HWY_INLINE Vector across(const Channels& channels) {
    // A 4x4 transposition by halves: (0, 1) and (2, 3) first.
    const auto pair = [](Vector a, Vector b) {
        return hn::Add(hn::InterleaveLower(Lanes(), a, b), hn::InterleaveUpper(Lanes(), a, b));
    };
    const auto a = hn::BitCast(Wide(), pair(channels.of[0], channels.of[1]));  // 0 1 0 1
    const auto b = hn::BitCast(Wide(), pair(channels.of[2], channels.of[3]));  // 2 3 2 3
    return hn::Add(hn::BitCast(Lanes(), hn::InterleaveLower(Wide(), a, b)),
                   hn::BitCast(Lanes(), hn::InterleaveUpper(Wide(), a, b)));
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
    constexpr int o = 0x80;
    alignas(16) static constexpr std::uint8_t kTo0[16] = {0, 4, 8, o, o, o, o, o, o, o, o, o, o, o, o, o};
    alignas(16) static constexpr std::uint8_t kTo1[16] = {o, o, o, o, 0, 4, 8, o, o, o, o, o, o, o, o, o};
    alignas(16) static constexpr std::uint8_t kTo2[16] = {o, o, o, o, o, o, o, o, 0, 4, 8, o, o, o, o, o};
    alignas(16) static constexpr std::uint8_t kTo3[16] = {o, o, o, o, o, o, o, o, o, o, o, o, 0, 4, 8, o};
    const Vector colour = hn::Or(hn::Or(rearranged(quotients.of[0], kTo0), rearranged(quotients.of[1], kTo1)),
                                 hn::Or(rearranged(quotients.of[2], kTo2), rearranged(quotients.of[3], kTo3)));
    return hn::IfThenElseZero(hn::Gt(alpha, hn::Zero(Lanes())), hn::Or(colour, hn::ShiftLeft<24>(alpha)));
}

}  // namespace rs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
