#pragma once
// Reconstruction of a unit's samples from its choices, shared by decoder and encoder. encode/FORMAT.md, section
// "Reconstruction".

#include "rayspace/codec/code/dense_code.hpp"
#include "rayspace/codec/dense_tile.hpp"
#include "rayspace/codec/prediction_unit.hpp"

#include <array>

namespace rs::codec {

struct UnitPosition {
    int x = 0;  // first sample in the image
    int y = 0;
    int size = kMacroblock;
    bool has_left = false;  // a neighbour in the tile that is not empty
    bool has_above = false;
};

inline UnitPosition unit_position(const TileGrid& grid, const PredictionUnit& unit, int tile_left, int tile_top) {
    return {tile_left + unit.bx * kBlock, tile_top + unit.by * kBlock, unit.size,
            grid.at(unit.bx - 1, unit.by).source != Source::kNone,
            grid.at(unit.bx, unit.by - 1).source != Source::kNone};
}

/// Records a decoded unit in the grid, for the contexts of later units.
inline void record_unit(TileGrid& grid, const PredictionUnit& unit, const UnitChoice& choice) {
    for (int i = 0; i < unit.blocks() * unit.blocks(); ++i) {
        BlockInfo& info = grid.at(unit.bx + (i & (unit.blocks() - 1)), unit.by + i / unit.blocks());
        info.source = choice.source;
        info.coded = choice.coded;
        info.small_transforms = choice.coded && choice.transforms(unit.size) > 1;
        info.motion = choice.motion;
    }
}

/// The references' alpha level at sample (x, y); -1 if the unit has no references.
int predict_alpha(const UnitChoice& choice, const std::array<ConstPlaneViews, 2>& references, int x, int y,
                  int alpha_bits);

/// Predicts one plane (0 .. 2) at `place` into `out`.
void predict_unit(const UnitChoice& choice, const UnitPosition& place, int plane,
                  const std::array<ConstPlaneViews, 2>& references, ImageView<std::uint8_t> out);

/// Reconstructs Y, U and V: prediction plus residual.
void reconstruct_unit(const UnitChoice& choice, const UnitPosition& place, int step, const DenseCode& code,
                      const std::array<ConstPlaneViews, 2>& references, const PlaneViews& out);

/// Adds the residual of one transform to `size` x `size` samples.
void add_residual(const Levels& levels, int step, int size, std::uint8_t* samples, std::ptrdiff_t stride);

}  // namespace rs::codec
