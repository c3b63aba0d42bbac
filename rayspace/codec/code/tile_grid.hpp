#pragma once
// State of the 8x8 blocks of a tile while it is read or written, from which the contexts of later decisions are
// derived.

#include "rayspace/codec/kernels/prediction.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace rs::codec {

inline constexpr int kBlock = 8;
inline constexpr int kMacroblock = 16;
inline constexpr int kMinTileLog2 = 4;
inline constexpr int kMaxTileLog2 = 6;

enum class AlphaClass : std::uint8_t { kOutside, kEmpty, kOpaque, kMixed };  // kOutside: beyond the tile or the image

enum class Source : std::uint8_t { kNone, kIntra, kFirst, kSecond, kBoth };  // kNone: not coded
constexpr bool is_inter(Source source) {
    return source >= Source::kFirst;
}
constexpr bool uses(Source source, int reference) {
    return source == Source::kBoth || source == (reference == 0 ? Source::kFirst : Source::kSecond);
}

struct BlockInfo {
    AlphaClass alpha = AlphaClass::kOutside;
    Source source = Source::kNone;
    bool split = false;             // belongs to a macroblock in four units
    bool coded = false;             // its unit has coefficients
    bool small_transforms = false;  // its unit is a macroblock with 8x8 transforms
    std::array<MotionVector, 2> motion;
};

/// Blocks (-1 .. n - 1, -1 .. n - 1) of a tile; those to the left of it and above it are kOutside.
class TileGrid {
public:
    BlockInfo& at(int bx, int by) { return blocks_[static_cast<std::size_t>((by + 1) * kSide + bx + 1)]; }
    [[nodiscard]] const BlockInfo& at(int bx, int by) const {
        return blocks_[static_cast<std::size_t>((by + 1) * kSide + bx + 1)];
    }
    void clear() { blocks_.fill(BlockInfo{}); }

private:
    static constexpr int kSide = (1 << kMaxTileLog2) / kBlock + 1;
    std::array<BlockInfo, static_cast<std::size_t>(kSide* kSide)> blocks_;
};

/// A unit: a macroblock (size 16) or one of its four blocks (8). bx, by: its first block in the tile.
struct PredictionUnit {
    int bx = 0;
    int by = 0;
    int size = kMacroblock;
    [[nodiscard]] int blocks() const { return size / kBlock; }
};

/// Predicts a vector: the median of the vectors of the left and upper blocks and `global`; the vector of the only one
/// of both blocks that uses the reference; `global` if neither does.
inline MotionVector predict_motion(const TileGrid& grid, const PredictionUnit& unit, int reference,
                                   MotionVector global) {
    const BlockInfo& left = grid.at(unit.bx - 1, unit.by);
    const BlockInfo& above = grid.at(unit.bx, unit.by - 1);
    const bool of_left = uses(left.source, reference);
    const bool of_above = uses(above.source, reference);
    const auto n = static_cast<std::size_t>(reference);
    if (of_left && !of_above) return left.motion[n];
    if (of_above && !of_left) return above.motion[n];
    if (!of_left) return global;
    const auto median = [](std::int16_t a, std::int16_t b, std::int16_t c) {
        return std::max(std::min(a, b), std::min(std::max(a, b), c));
    };
    return {median(left.motion[n].x, above.motion[n].x, global.x),
            median(left.motion[n].y, above.motion[n].y, global.y)};
}

}  // namespace rs::codec
