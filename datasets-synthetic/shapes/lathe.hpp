#pragma once
// Surfaces of revolution about the Y axis.

#include "capture/tracer/scene/scene.hpp"

#include <span>

namespace rs::synthetic {

struct LatheStyle {
    int segments = 160;             // around
    float crease_rad = 0.6F;        // a sharper bend of the profile is an edge, a gentler one is smooth
    glm::vec2 v_range{0.0F, 1.0F};  // texture v at the profile's ends; by arc length between
    glm::vec2 offset{0.0F, 0.0F};   // the axis stands at (x, z)
};

// Turns `profile` (at least 2 points of (radius >= 0, height), neighbours differ) about the axis. Walking along the
// profile with the axis on the left and Y up, the outside is on the right: a solid starts on the axis at its bottom and
// ends there at its top. Points with radius 0 are poles. Texture u runs once around, to the right as seen from outside,
// from 0 at +Z.
void append_lathe(capture::Mesh& mesh, std::span<const glm::vec2> profile, const LatheStyle& style = {});

}  // namespace rs::synthetic
