#pragma once
// Smooths the edges that coding leaves between the blocks of a tile; what is predicted from an image is predicted from
// the smoothed one. The rules are those of HEVC's filter (ITU-T H.265, 8.7.2.5) with thresholds of our quantiser's
// steps. Integer and normative: encode/FORMAT.md, section "Edges of blocks".

#include "rayspace/codec/code/dense_code.hpp"
#include "rayspace/codec/code/tile_grid.hpp"
#include "rayspace/codec/dense_tile.hpp"

namespace rs::codec {

// Y, U and V of the tile at `place`, whose units are all decoded. `step`: of the image. Does nothing where the code
// has no edge filter.
void filter_edges(const TileGrid& grid, const DenseCode& code, int step, const TilePlace& place, const PlaneViews& out);

}  // namespace rs::codec
