#pragma once
// The samples of a unit from its choices; the same for decoder and encoder. encode/FORMAT.md, section
// "Reconstruction".

#include "rayspace/codec/code/dense_code.hpp"
#include "rayspace/codec/dense_tile.hpp"
#include "rayspace/codec/prediction_unit.hpp"

#include <array>

namespace rs::codec {

struct UnitPlace {
    int x = 0;  // first sample in the image
    int y = 0;
    int size = kMacroblock;
    bool has_left = false;  // neighbours in the tile that are not empty
    bool has_above = false;
};

inline UnitPlace place_of_unit(const TileGrid& grid, const PredictionUnit& unit, int tile_left, int tile_top) {
    return {tile_left + unit.bx * kBlock, tile_top + unit.by * kBlock, unit.size,
            grid.at(unit.bx - 1, unit.by).source != Source::kNone,
            grid.at(unit.bx, unit.by - 1).source != Source::kNone};
}

// What the blocks of a decoded unit leave for those that come after.
inline void enter_unit(TileGrid& grid, const PredictionUnit& unit, const UnitChoice& choice) {
    for (int i = 0; i < unit.blocks() * unit.blocks(); ++i) {
        BlockInfo& info = grid.at(unit.bx + (i & (unit.blocks() - 1)), unit.by + i / unit.blocks());
        info.source = choice.source;
        info.coded = choice.coded;
        info.small_transforms = choice.coded && choice.transforms(unit.size) > 1;
        info.motion = choice.motion;
    }
}

// The alpha level that the predicting images show at sample (x, y); -1 where the unit has none.
int predicted_alpha(const UnitChoice& choice, const std::array<ConstPlaneViews, 2>& references, int x, int y,
                    int alpha_bits);

// The prediction of one plane (0 .. 2) at `place`, written there.
void predict_unit(const UnitChoice& choice, const UnitPlace& place, int plane,
                  const std::array<ConstPlaneViews, 2>& references, ImageView<std::uint8_t> out);

// Prediction and coefficients of Y, U and V.
void reconstruct_unit(const UnitChoice& choice, const UnitPlace& place, int step, const DenseCode& code,
                      const std::array<ConstPlaneViews, 2>& references, const PlaneViews& out);

// Adds the residual of one transform to `size` x `size` samples.
void add_residual(const Levels& levels, int step, int size, std::uint8_t* samples, std::ptrdiff_t stride);

}  // namespace rs::codec
