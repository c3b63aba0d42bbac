#pragma once
// Deblocking filter for the edges between the blocks of a tile. Images are predicted from filtered ones. The rules are
// those of HEVC (ITU-T H.265, 8.7.2.5) with thresholds from this quantiser's steps. Integer and normative:
// encode/FORMAT.md, section "Edges of blocks".

#include "rayspace/codec/code/dense_code.hpp"
#include "rayspace/codec/code/tile_grid.hpp"
#include "rayspace/codec/dense_tile.hpp"

namespace rs::codec {

/// Filters Y, U and V of the tile at `place` after all its units are decoded. `step`: the image's quantiser step. Does
/// nothing if deblocking is off.
void filter_edges(const TileGrid& grid, const DenseCode& code, int step, const TileRect& place, const PlaneViews& out);

}  // namespace rs::codec
