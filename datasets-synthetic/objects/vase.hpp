#pragma once
// A painted porcelain vase: a surface of revolution with a wall of real thickness, open at the top, under a glossy
// coat. Hard for image-based rendering because highlights wander over the painting as the viewpoint moves.
//
// Parameter   default  range        meaning
// height      2.2      1.8..2.8     foot to lip
// belly       0.66     0.5..0.8     largest radius
// neck        0.22     0.15..0.32   smallest radius above the belly
// flowers     5        3..8         pairs of peonies around the belly
// roughness   0.12     0.02..0.6    of the glaze
// Lengths are relative to each other: the object is scaled to radius 1.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>

namespace rs::synthetic {

Result<capture::Scene> generate_vase(const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
