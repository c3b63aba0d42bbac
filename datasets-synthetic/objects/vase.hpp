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
#include <span>

namespace rs::synthetic {

// The cobalt-blue painting of the porcelain vase: lappets at the foot, a scroll of peonies around the belly, a meander
// on the shoulder, plantain leaves on the neck, gold at the rim. Drawn stroke by stroke, each with its own wash and
// pressure, so no two flowers are alike and every view of the vase can be told from every other.

struct VasePainting {
    int width_px = 2048;
    int flowers = 5;  // around the belly
    std::uint64_t seed = 1;
};

// `outer_profile`: (radius, height) from foot to lip; texture v is arc length along it. The image's height is
// chosen so that pixels are square where the vase is widest; where it is narrower, motifs are drawn wider to make up
// for it.
capture::Texture paint_vase(std::span<const glm::vec2> outer_profile, const VasePainting& painting);

Result<capture::Scene> generate_vase(const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
