#pragma once
// FORMAT.md, "Edges of blocks": the smoothing of one edge. Which edges are smoothed is TileDecoder's to say.

#include "tests/reference/decoder/reference_decoder.hpp"

namespace rs::reference {

// Sample (x, y) of the image is the first one of block B: the right one of an upright edge, the lower one of a level
// one. The 8 samples to its left (above it) are block A's, and q is that of "Reconstruction".
struct Edge {
    int plane, x, y;
    bool is_upright;
    int q;
};

void smooth_edge(DecodedImage& image, const Edge& edge);

}  // namespace rs::reference
