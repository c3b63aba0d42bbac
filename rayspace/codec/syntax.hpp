#pragma once
// Syntax of dense images, shared by reader and writer: encode/FORMAT.md, section "Syntax".
//
// A Coder has   int bit(int context, int value)   and   int raw(int value):   a reader ignores `value` and returns the
// decoded value; a writer writes `value` and returns it; an estimator adds up its cost. Every function takes the values
// to be written and returns, or fills in, the values that are then known.

#include "rayspace/codec/code/contexts.hpp"
#include "rayspace/codec/code/tile_grid.hpp"
#include "rayspace/codec/kernels/transform.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>

namespace rs::codec::syntax {

/// Codes `value` below 2^bits as a binary tree of `bits` decisions, highest bit first, each in the context of the
/// previous ones.
template <class Coder>
int tree(Coder& coder, int context, int bits, int value) {
    int node = 1;
    for (int i = bits - 1; i >= 0; --i) node = 2 * node + coder.bit(context + node - 1, (value >> i) & 1);
    return node - (1 << bits);
}

/// Codes a number 0 .. 2^(places) - 1: its bit length in unary (contexts class_context + 0 ..), its second highest bit
/// (top_context + length), and the lower bits raw.
template <class Coder>
int number(Coder& coder, int class_context, int places, int top_context, int value) {
    const int wanted = std::bit_width(static_cast<unsigned>(value));
    int length = 0;
    while (length < places && coder.bit(class_context + length, wanted > length ? 1 : 0) != 0) ++length;
    if (length < 2) return length;
    int read = 2 + coder.bit(top_context + length, (value >> (length - 2)) & 1);
    for (int i = length - 3; i >= 0; --i) read = 2 * read + coder.raw((value >> i) & 1);
    return read;
}

/// Codes the alpha class of a macroblock (context::kMacroblockAlpha) or a block (kBlockAlpha).
template <class Coder>
AlphaClass alpha_class(Coder& coder, int context, AlphaClass left, AlphaClass above, AlphaClass value) {
    const int at = context + 2 * (4 * static_cast<int>(left) + static_cast<int>(above));
    if (coder.bit(at, value == AlphaClass::kEmpty ? 0 : 1) == 0) return AlphaClass::kEmpty;
    return coder.bit(at + 1, value == AlphaClass::kMixed ? 1 : 0) != 0 ? AlphaClass::kMixed : AlphaClass::kOpaque;
}

template <class Coder>
bool split(Coder& coder, const TileGrid& grid, int bx, int by, bool value) {
    const int neighbours = (grid.at(bx - 1, by).split ? 1 : 0) + (grid.at(bx, by - 1).split ? 1 : 0);
    return coder.bit(context::kSplit + neighbours, value ? 1 : 0) != 0;
}

/// The number of the two neighbours that fulfil the condition.
template <class Condition>
int count_neighbours(const TileGrid& grid, const PredictionUnit& unit, const Condition& condition) {
    return (condition(grid.at(unit.bx - 1, unit.by)) ? 1 : 0) + (condition(grid.at(unit.bx, unit.by - 1)) ? 1 : 0);
}

constexpr int size_index(int size) {
    return size == kMacroblock ? 1 : 0;
}

/// Codes the source of a unit's prediction. `references`: number of reference images, 0 .. 2.
template <class Coder>
Source source(Coder& coder, const TileGrid& grid, const PredictionUnit& unit, int references, Source value) {
    if (references == 0) return Source::kIntra;
    const int size = size_index(unit.size);
    const int inter = count_neighbours(grid, unit, [](const BlockInfo& b) { return is_inter(b.source); });
    if (coder.bit(context::kInter + 3 * size + inter, is_inter(value) ? 1 : 0) == 0) return Source::kIntra;
    if (references == 1) return Source::kFirst;
    const int both = count_neighbours(grid, unit, [](const BlockInfo& b) { return b.source == Source::kBoth; });
    if (coder.bit(context::kBoth + 3 * size + both, value == Source::kBoth ? 1 : 0) != 0) return Source::kBoth;
    const int second = count_neighbours(grid, unit, [](const BlockInfo& b) { return b.source == Source::kSecond; });
    return coder.bit(context::kSecond + 3 * size + second, value == Source::kSecond ? 1 : 0) != 0 ? Source::kSecond
                                                                                                  : Source::kFirst;
}

template <class Coder>
int intra_mode(Coder& coder, const PredictionUnit& unit, int value) {
    return tree(coder, context::kIntraMode + 7 * size_index(unit.size), 3, value);
}

/// Codes the difference of a vector from its prediction. A read vector may exceed +-kMaxMotion_q2: the caller clamps
/// it.
template <class Coder>
std::array<int, 2> motion(Coder& coder, const PredictionUnit& unit, std::array<int, 2> value) {
    constexpr int kPlaces = 10;
    const int zero = context::kMotionZero + size_index(unit.size);
    if (coder.bit(zero, value[0] != 0 || value[1] != 0 ? 1 : 0) == 0) return {0, 0};
    std::array<int, 2> read = {0, 0};
    for (int c = 0; c < 2; ++c) {
        const int wanted = value[static_cast<std::size_t>(c)];
        // Not both are zero.
        const bool must_be = c == 1 && read[0] == 0;
        if (!must_be && coder.bit(context::kComponentZero + c, wanted != 0 ? 1 : 0) == 0) continue;
        const int sign = coder.bit(context::kComponentSign + c, wanted < 0 ? 1 : 0);
        const int size = 1 + number(coder, context::kComponentClass + 10 * c, kPlaces,
                                    context::kComponentTop + 10 * c - 1, std::abs(wanted) - 1);
        read[static_cast<std::size_t>(c)] = sign != 0 ? -size : size;
    }
    return read;
}

/// Codes whether a unit has any coefficients.
template <class Coder>
bool coded(Coder& coder, const TileGrid& grid, const PredictionUnit& unit, bool inter, bool value) {
    const int neighbours = count_neighbours(grid, unit, [](const BlockInfo& b) { return b.coded; });
    return coder.bit(context::kCoded + 3 * (2 * size_index(unit.size) + (inter ? 1 : 0)) + neighbours, value ? 1 : 0) !=
           0;
}

// ------------------------------------------------------------------------------------------------------- coefficients

/// The positions of a block in diagonal order from the DC coefficient: [i] = v * size + u.
const std::uint8_t* scan_order(int size);

/// Context from the neighbours to the right and below of (u, v): the sum of their magnitudes, limited to 3 each,
/// halved, at most kNearSums - 1.
inline int near_sum(const Levels& levels, int u, int v) {
    const std::int16_t* const l = levels.at + v * Levels::kStride + u;
    const auto size = [](int level) { return std::min(std::abs(level), 3); };
    const int sum = size(l[1]) + size(l[2]) + size(l[Levels::kStride]) + size(l[2 * Levels::kStride]) +
                    size(l[Levels::kStride + 1]);
    return std::min((sum + 1) >> 1, context::kNearSums - 1);
}

/// The kind of coefficient block, as in contexts.hpp.
constexpr int block_kind(int plane, int transform_size, bool inter) {
    return (plane == 0 ? 0 : 4) + 2 * size_index(transform_size) + (inter ? 1 : 0);
}

constexpr int band_of(int diagonal, int size) {
    if (diagonal == 0) return 0;
    const int d = size == 8 ? diagonal : (diagonal + 1) / 2;
    return d <= 2 ? 1 : d <= 5 ? 2 : 3;
}

/// Codes the magnitude of one level; `must_be`: known not to be zero.
template <class Coder>
int magnitude(Coder& coder, int kind, int band, int near, bool must_be, int value) {
    if (!must_be) {
        const int at = context::kNonZero + (kind * context::kBands + band) * context::kNearSums + near;
        if (coder.bit(at, value != 0 ? 1 : 0) == 0) return 0;
    }
    const int more = (2 * kind + (band == 0 ? 1 : 0)) * context::kNearSums + near;
    int read = 1;
    if (coder.bit(context::kAboveOne + more, value > 1 ? 1 : 0) != 0) {
        read = 2;
        if (coder.bit(context::kAboveTwo + more, value > 2 ? 1 : 0) != 0) {
            // Up to 2^14 + 1; the second highest bit has no context of its own.
            const int wanted = value - 3 + 1;
            int length = 1;
            while (length < 14 &&
                   coder.bit(context::kRestClass + 14 * kind + length - 1, (wanted >> length) != 0 ? 1 : 0) != 0) {
                ++length;
            }
            int rest = 1;
            for (int i = length - 2; i >= 0; --i) rest = 2 * rest + coder.raw((wanted >> i) & 1);
            read = 3 + rest - 1;
        }
    }
    return read;
}

/// Codes the scan position of the last non-zero level.
template <class Coder>
int last_place(Coder& coder, int kind, int size, int value) {
    return number(coder, context::kLastClass + 8 * kind, size == 8 ? 6 : 8, context::kLastTop + 9 * kind, value);
}

/// Levels are processed in groups of kSignGroup positions. With sign data hiding, the sign of a group's lowest non-zero
/// level is the parity of the sum of its magnitudes, if the highest one is at least kHidingSpan positions above it.
inline constexpr int kSignGroup = 16;
inline constexpr int kHidingSpan = 4;

/// Codes a block with at least one non-zero level. `levels` contains the values to be written, or zeros, and is filled
/// in; `last`: the scan position of the last one, for a writer.
template <class Coder>
void block(Coder& coder, int kind, int size, bool sign_data_hiding, Levels& levels, int last) {
    const std::uint8_t* const scan = scan_order(size);
    const auto at = [&](int i) -> std::int16_t& {
        return levels.at[(scan[i] / size) * Levels::kStride + (scan[i] & (size - 1))];
    };
    last = last_place(coder, kind, size, last);
    int places[kSignGroup];  // positions of the group's non-zero levels, from the highest
    int found = 0;
    int sum = 0;
    for (int i = last; i >= 0; --i) {
        const int u = scan[i] & (size - 1);
        const int v = scan[i] / size;
        const int wanted = at(i);
        const int read =
            magnitude(coder, kind, band_of(u + v, size), near_sum(levels, u, v), i == last, std::abs(wanted));
        if (read != 0) {
            at(i) = static_cast<std::int16_t>(wanted < 0 ? -read : read);
            levels.used = std::max(levels.used, std::max(u, v) + 1);
            places[found++] = i;
            sum += read;
        }
        if (sign_data_hiding && (i & (kSignGroup - 1)) != 0) continue;
        const bool hides = sign_data_hiding && found > 0 && places[0] - places[found - 1] >= kHidingSpan;
        for (int n = 0; n < found; ++n) {
            std::int16_t& one = at(places[n]);
            const int negative = hides && n + 1 == found ? sum & 1 : coder.raw(one < 0 ? 1 : 0);
            const int size_of_one = std::abs(one);
            one = static_cast<std::int16_t>(negative != 0 ? -size_of_one : size_of_one);
        }
        found = 0;
        sum = 0;
    }
}

// -------------------------------------------------------------------------------------------------------------- alpha

/// 0: transparent, 2: covered, 1: between.
constexpr int alpha_kind(int alpha, int full) {
    return alpha == 0 ? 0 : alpha == full ? 2 : 1;
}

/// Codes one sample of a mixed block, 0 .. full (full = 2^bits - 1). Neighbours outside of the tile count as 0.
/// \param predicted  alpha level of the reference's sample, -1 if there is none.
template <class Coder>
int alpha_sample(Coder& coder, int bits, int west, int north, int north_west, int north_east, int predicted,
                 int value) {
    const int full = (1 << bits) - 1;
    const auto kind = [&](int alpha) { return alpha_kind(alpha, full); };
    const int from = predicted < 0 ? 0 : 1 + kind(predicted);
    const int near = ((kind(west) * 3 + kind(north)) * 3 + kind(north_west)) * 3 + kind(north_east);
    if (coder.bit(context::kAlphaZero + 81 * from + near, value != 0 ? 1 : 0) == 0) return 0;
    if (bits == 1) return full;
    if (coder.bit(context::kAlphaFull + 81 * from + near, value != full ? 1 : 0) == 0) return full;
    const int mean = 3 * (west + north) / (2 * full + 1);
    return tree(coder, context::kAlphaBetween + 16 * mean, bits, value);
}

/// Codes the distance of a sample of a mixed block from the end of the range given by its mask, for two bits of alpha:
/// 0 or 1. \param sum         weighted sum of the mask around it, 0 .. 16. \param neighbours  number of the left and
/// upper neighbours with a distance that is not 0. \param predicted   0: no references; 1: these are at an end of the
/// range; 2: between.
template <class Coder>
int alpha_inner(Coder& coder, int mask, int sum, int neighbours, int predicted, int value) {
    return coder.bit(context::kInner + ((3 * neighbours + predicted) * 2 + mask) * 17 + sum, value);
}

/// Codes that distance for more bits, 0 .. 2^(bits - 1) - 1, as a difference from `guess`.
/// \param activity  variation of the neighbouring distances.
/// \param beside    1 if the mask around the sample differs from its own, else 0.
template <class Coder>
int alpha_depth(Coder& coder, int bits, int guess, int activity, int beside, int predicted, int value) {
    constexpr int kActivities = 6;
    const int most = (1 << (bits - 1)) - 1;
    const int at = kActivities * beside + (activity <= 2 ? activity : activity <= 4 ? 3 : activity <= 8 ? 4 : 5);
    const int off = coder.bit(context::kDepthOff + 2 * kActivities * predicted + at, value != guess ? 1 : 0);
    if (off == 0) return guess;
    int below = guess == most ? 1 : 0;
    if (guess > 0 && guess < most) below = coder.bit(context::kDepthBelow + at, value < guess ? 1 : 0);
    const int distance = 1 + number(coder, context::kDepthClass + 8 * beside, bits - 1, context::kDepthTop + 8 * beside,
                                    std::abs(value - guess) - 1);
    return std::clamp(below != 0 ? guess - distance : guess + distance, 0, most);
}

}  // namespace rs::codec::syntax
