#pragma once
// A tower of wooden letter blocks: planar faces, straight edges, sharp painted signs.
// Hard for image-based rendering because depth errors visibly bend straight lines or double edges.
//
// Parameter   default     range            meaning
// text        RAYSPACE    1..12 letters    painted around the blocks
// bevel       0.09        0.03..0.25       radius of the rounded edges, share of half a side
// untidiness  0.6         0..1             random rotation and shift of the blocks
// gloss       0.25        0.05..0.6        roughness of the varnish

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace rs::synthetic {

// Textures of the block faces: wood, a coloured frame, a letter or an image.

inline constexpr int kBlockFaces = 6;

// An atlas of square tiles, kBlockFaces to a row of tiles and one row per block: tile (f, b) covers u in [f, f+1] /
// kBlockFaces and v in [b, b+1] / blocks. Faces 0 to 3 are the sides, counter-clockwise seen from above; 4 is the top,
// 5 the underside. The letters of `text` are repeated around the blocks' sides.
capture::Texture paint_blocks(int blocks, const std::string& text, std::uint64_t seed);

Result<capture::Scene> generate_blocks(const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
