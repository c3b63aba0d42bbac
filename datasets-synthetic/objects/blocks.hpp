#pragma once
// A tower of wooden letter blocks: planar faces, straight edges, sharp painted signs.
// Hard for image-based rendering because every error of depth bends a line or doubles an edge that the eye knows to be
// straight.
//
// Parameter   default     range            meaning
// text        RAYSPACE    1..12 letters    painted around the blocks
// bevel       0.09        0.03..0.25       radius of the rounded edges, share of half a side
// untidiness  0.6         0..1             how far blocks are turned and shifted
// gloss       0.25        0.05..0.6        roughness of the varnish

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>

namespace rs::synthetic {

Result<capture::Scene> generate_blocks(const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
