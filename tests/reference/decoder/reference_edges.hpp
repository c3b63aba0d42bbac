#pragma once
// FORMAT.md, "Edges of blocks": filters one edge. TileDecoder selects the edges.

#include "tests/reference/decoder/reference_decoder.hpp"

namespace rs::reference {

/// Sample (x, y) of the image is the first one of block B: the right block of a vertical edge, the lower one of a
/// horizontal edge. The 8 samples to its left (above it) are block A's, and q is that of "Reconstruction".
struct Edge {
    int plane, x, y;
    bool is_upright;
    int q;
};

void smooth_edge(DecodedImage& image, const Edge& edge);

}  // namespace rs::reference
