#pragma once
// The samples of a part from what it says; the same for decoder and encoder. encode/FORMAT.md, section
// "Reconstruction".

#include "rayspace/codec/code/dense_code.hpp"
#include "rayspace/codec/dense_tile.hpp"
#include "rayspace/codec/prediction_unit.hpp"

#include <array>

namespace rs::codec {

struct PartPlace {
    int x = 0;  // first sample in the picture
    int y = 0;
    int size = kMacroblock;
    bool has_left = false;  // neighbours in the tile that are not empty
    bool has_above = false;
};

inline PartPlace place_of_part(const TileGrid& grid, const PredictionUnit& part, int tile_left, int tile_top) {
    return {tile_left + part.bx * kBlock, tile_top + part.by * kBlock, part.size,
            grid.at(part.bx - 1, part.by).source != Source::kNone,
            grid.at(part.bx, part.by - 1).source != Source::kNone};
}

// What the blocks of a part that is done tell those that come after.
inline void enter_part(TileGrid& grid, const PredictionUnit& part, const PartChoice& choice) {
    for (int i = 0; i < part.blocks() * part.blocks(); ++i) {
        BlockInfo& info = grid.at(part.bx + (i & (part.blocks() - 1)), part.by + i / part.blocks());
        info.source = choice.source;
        info.coded = choice.coded;
        info.small_transforms = choice.coded && choice.transforms(part.size) > 1;
        info.motion = choice.motion;
    }
}

// The alpha level that the predicting pictures show at sample (x, y); -1 where the part has none.
int predicted_alpha(const PartChoice& choice, const std::array<ConstPlaneViews, 2>& references, int x, int y,
                    int alpha_bits);

// The prediction of one plane (0 .. 2) at `place`, written there.
void predict_part(const PartChoice& choice, const PartPlace& place, int plane,
                  const std::array<ConstPlaneViews, 2>& references, ImageView<std::uint8_t> out);

// Prediction and coefficients of Y, U and V.
void reconstruct_unit(const PartChoice& choice, const PartPlace& place, int step, const DenseCode& code,
                      const std::array<ConstPlaneViews, 2>& references, const PlaneViews& out);

// Adds the residual of one transform to `size` x `size` samples.
void add_residual(const Levels& levels, int step, int size, std::uint8_t* samples, std::ptrdiff_t stride);

}  // namespace rs::codec
