#pragma once
// A painted porcelain vase: a surface of revolution with a wall of real thickness, open at the top, under a glossy
// coat. Hard for image-based rendering because highlights move over the painting with the viewpoint.
//
// Parameter   default  range        meaning
// height      2.2      1.8..2.8     foot to lip
// belly       0.66     0.5..0.8     largest radius
// neck        0.22     0.15..0.32   smallest radius above the belly
// flowers     5        3..8         pairs of peonies around the belly
// roughness   0.12     0.02..0.6    of the glaze
// Lengths are relative: the object is scaled to radius 1.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <span>

namespace rs::synthetic {

// The cobalt-blue painting of the porcelain vase: lappets at the foot, a scroll of peonies around the belly, a meander
// on the shoulder, plantain leaves on the neck, gold at the rim. Wash and pressure vary by stroke, so that all flowers
// differ and every view of the vase is unique.

struct VasePainting {
    int width_px = 2048;
    int flowers = 5;  // around the belly
    std::uint64_t seed = 1;
};

// `outer_profile`: (radius, height) from foot to lip; texture v is arc length along it. Pixels are square at the
// largest radius; motifs at smaller radii are widened in compensation.
capture::Texture paint_vase(std::span<const glm::vec2> outer_profile, const VasePainting& painting);

Result<capture::Scene> generate_vase(const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
