#pragma once
// The faces of the toy blocks: wood, a coloured frame, a letter or a picture.

#include "capture/tracer/scene/scene.hpp"

#include <cstdint>
#include <string>

namespace rs::synthetic {

inline constexpr int kBlockFaces = 6;

// An atlas of square tiles, kBlockFaces to a row of tiles and one row per block: tile (f, b) covers u in [f, f+1] /
// kBlockFaces and v in [b, b+1] / blocks. Faces 0 to 3 are the sides, counter-clockwise seen from above; 4 is the top,
// 5 the underside. The letters of `text` go around the blocks' sides in turn, again and again.
capture::Texture paint_blocks(int blocks, const std::string& text, std::uint64_t seed);

}  // namespace rs::synthetic
