#pragma once
// Syntax of a macroblock's alpha and a unit's choices in stream order: encode/FORMAT.md, sections "Macroblocks" and
// "Parts". Built from the single decisions of syntax.hpp; shared by decoder and encoder.

#include "rayspace/codec/code/tile_grid.hpp"
#include "rayspace/codec/syntax.hpp"

#include <array>
#include <cstdint>
#include <cstring>

namespace rs::codec {

/// Alpha levels 0 .. 2^bits - 1 of a tile, or its mask, with a margin of zeros above and on both sides.
class AlphaLevels {
public:
    void clear() { std::memset(levels_, 0, sizeof levels_); }
    std::uint8_t& at(int x, int y) { return levels_[(y + kMargin) * kStride + x + kMargin]; }
    [[nodiscard]] const std::uint8_t& at(int x, int y) const { return levels_[(y + kMargin) * kStride + x + kMargin]; }
    void fill_block(int bx, int by, int level) {
        for (int y = 0; y < kBlock; ++y) std::memset(&at(bx * kBlock, by * kBlock + y), level, kBlock);
    }

private:
    static constexpr int kMargin = 2;
    static constexpr int kStride = (1 << kMaxTileLog2) + 2 * kMargin;
    std::uint8_t levels_[(kMargin + (1 << kMaxTileLog2)) * kStride] = {};
};

constexpr int alpha_of_level(int level, int bits) {
    return (level * 255 + ((1 << bits) - 1) / 2) / ((1 << bits) - 1);
}
constexpr int level_of_alpha(int alpha, int bits) {
    return (alpha * ((1 << bits) - 1) + 127) / 255;
}

inline constexpr int kPlanes = 3;  // Y, U, V

/// All choices of a unit except its alpha.
struct UnitChoice {
    Source source = Source::kIntra;
    int intra_mode = 0;
    std::array<MotionVector, 2> motion;
    bool coded = false;
    bool small_transforms = false;  // 16x16 unit only: four transforms of 8x8 in every plane
    std::array<std::array<bool, 4>, kPlanes> plane_coded = {};
    std::array<std::array<Levels, 4>, kPlanes> levels;
    std::array<std::array<int, 4>, kPlanes> last = {};  // scan positions, set by a writer

    [[nodiscard]] int transform_size(int unit_size) const {
        return unit_size == kMacroblock && !small_transforms ? kMacroblock : kBlock;
    }
    [[nodiscard]] int transforms(int unit_size) const { return unit_size == kMacroblock && small_transforms ? 4 : 1; }
};

/// Codes a mixed block's alpha. predicted(x, y): the references' level at sample (x, y) of the tile, -1 if there is
/// none.
template <class Coder, class Predicted>
void code_block_alpha(Coder& coder, AlphaLevels& alpha, int bits, int bx, int by, const Predicted& predicted) {
    for (int y = by * kBlock; y < (by + 1) * kBlock; ++y) {
        for (int x = bx * kBlock; x < (bx + 1) * kBlock; ++x) {
            // The upper right sample is used only if it has been coded, else the one above.
            const bool later = (x & (kBlock - 1)) == kBlock - 1;
            const int north = alpha.at(x, y - 1);
            alpha.at(x, y) = static_cast<std::uint8_t>(
                syntax::alpha_sample(coder, bits, alpha.at(x - 1, y), north, alpha.at(x - 1, y - 1),
                                     later ? north : alpha.at(x + 1, y - 1), predicted(x, y), alpha.at(x, y)));
        }
    }
}

/// Codes a mixed block's mask. predicted(x, y): the context class of the references' alpha (mask_context).
template <class Coder, class Predicted>
void code_block_mask(Coder& coder, AlphaLevels& mask, int bx, int by, const Predicted& predicted) {
    for (int y = by * kBlock; y < (by + 1) * kBlock; ++y) {
        for (int x = bx * kBlock; x < (bx + 1) * kBlock; ++x) {
            // The upper right sample is used only if it has been coded, else the one above.
            const int north = mask.at(x, y - 1);
            const int north_east = (x & (kBlock - 1)) == kBlock - 1 ? north : mask.at(x + 1, y - 1);
            const int before = mask.at(x - 1, y) + 2 * north + 4 * mask.at(x - 1, y - 1) + 8 * north_east +
                               16 * mask.at(x - 2, y) + 32 * mask.at(x, y - 2);
            mask.at(x, y) =
                static_cast<std::uint8_t>(coder.bit(context::kMask + 64 * predicted(x, y) + before, mask.at(x, y)));
        }
    }
}

/// Codes the alpha classes of the macroblock at block (bx, by) and of its blocks; reads them from the grid if the coder
/// writes, else stores them there. Returns false if the macroblock is empty and nothing follows.
template <class Coder>
bool code_macroblock_alpha(Coder& coder, TileGrid& grid, int bx, int by) {
    const auto block = [&](int i) -> BlockInfo& { return grid.at(bx + (i & 1), by + (i >> 1)); };
    AlphaClass whole = block(0).alpha;
    for (int i = 1; i < 4; ++i) {
        if (block(i).alpha != whole) whole = AlphaClass::kMixed;
    }
    whole = syntax::alpha_class(coder, context::kMacroblockAlpha, grid.at(bx - 1, by).alpha, grid.at(bx, by - 1).alpha,
                                whole);
    for (int i = 0; i < 4; ++i) {
        if (whole != AlphaClass::kMixed) {
            block(i).alpha = whole;
            continue;
        }
        const int x = bx + (i & 1);
        const int y = by + (i >> 1);
        block(i).alpha = syntax::alpha_class(coder, context::kBlockAlpha, grid.at(x - 1, y).alpha,
                                             grid.at(x, y - 1).alpha, block(i).alpha);
    }
    return whole != AlphaClass::kEmpty;
}

struct UnitSurroundings {
    int references = 0;
    std::array<MotionVector, 2> global_motion;
};

/// Codes the prediction of a unit.
template <class Coder>
void code_prediction(Coder& coder, const TileGrid& grid, const PredictionUnit& unit, const UnitSurroundings& around,
                     UnitChoice& choice) {
    choice.source = syntax::source(coder, grid, unit, around.references, choice.source);
    if (!is_inter(choice.source)) {
        choice.intra_mode = syntax::intra_mode(coder, unit, choice.intra_mode);
        return;
    }
    for (int r = 0; r < 2; ++r) {
        if (!uses(choice.source, r)) continue;
        const auto n = static_cast<std::size_t>(r);
        const MotionVector from = predict_motion(grid, unit, r, around.global_motion[n]);
        const auto off = syntax::motion(coder, unit, {choice.motion[n].x - from.x, choice.motion[n].y - from.y});
        const auto component = [](int value) {
            return static_cast<std::int16_t>(std::clamp(value, -kMaxMotion_q2, kMaxMotion_q2));
        };
        choice.motion[n] = {component(from.x + off[0]), component(from.y + off[1])};
    }
}

/// Codes the coefficients of a unit, whose prediction is known.
template <class Coder>
void code_coefficients(Coder& coder, const TileGrid& grid, const PredictionUnit& unit, bool sign_data_hiding,
                       UnitChoice& choice) {
    const int inter = is_inter(choice.source) ? 1 : 0;
    choice.coded = syntax::coded(coder, grid, unit, inter != 0, choice.coded);
    if (!choice.coded) return;
    if (unit.size == kMacroblock) {
        choice.small_transforms = coder.bit(context::kSmallTransforms + inter, choice.small_transforms ? 1 : 0) != 0;
    }
    const int size = choice.transform_size(unit.size);
    const int large = size == kMacroblock ? 1 : 0;
    int before = 0;
    for (std::size_t plane = 0; plane < kPlanes; ++plane) {
        const int kind = syntax::block_kind(static_cast<int>(plane), size, inter != 0);
        const int at = context::kPlaneCoded + 2 * (4 * static_cast<int>(plane) + 2 * large + inter);
        for (std::size_t t = 0; t < static_cast<std::size_t>(choice.transforms(unit.size)); ++t) {
            bool& has = choice.plane_coded[plane][t];
            has = coder.bit(at + before, has ? 1 : 0) != 0;
            if (!has) continue;
            syntax::block(coder, kind, size, sign_data_hiding, choice.levels[plane][t], choice.last[plane][t]);
            before = 1;
        }
    }
}

}  // namespace rs::codec
