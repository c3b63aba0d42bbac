#pragma once
// The cobalt-blue painting of the porcelain vase: lappets at the foot, a scroll of peonies around the belly, a meander
// on the shoulder, plantain leaves on the neck, gold at the rim. Drawn stroke by stroke, each with its own wash and
// pressure, so no two flowers are alike and every view of the vase can be told from every other.

#include "capture/tracer/scene/scene.hpp"

#include <cstdint>
#include <span>

namespace rs::synthetic {

struct VasePainting {
    int width_px = 2048;
    int flowers = 5;  // around the belly
    std::uint64_t seed = 1;
};

// `outer_profile`: (radius, height) from foot to lip; texture v is arc length along it. The picture's height is
// chosen so that pixels are square where the vase is widest; where it is narrower, motifs are drawn wider to make up
// for it.
capture::Texture paint_vase(std::span<const glm::vec2> outer_profile, const VasePainting& painting);

}  // namespace rs::synthetic
