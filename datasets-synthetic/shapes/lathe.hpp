#pragma once
// Surfaces of revolution about the Y axis.

#include "capture/tracer/scene/scene.hpp"

#include <span>

namespace rs::synthetic {

struct LatheStyle {
    int segments = 160;             // around
    float crease_rad = 0.6F;        // bends of the profile above this angle are creases
    glm::vec2 v_range{0.0F, 1.0F};  // texture v at the profile's ends; by arc length between
    glm::vec2 offset{0.0F, 0.0F};   // (x, z) of the axis
};

// Rotates `profile` (at least 2 points of (radius >= 0, height), neighbours differ) about the axis. The outside is to
// the right of the profile's direction if the axis is to the left and Y is up: a solid's profile starts on the axis at
// its bottom and ends on the axis at its top. Points with radius 0 are poles. Texture u runs once around, to the right
// as seen from outside, from 0 at +Z.
void append_lathe(capture::Mesh& mesh, std::span<const glm::vec2> profile, const LatheStyle& style = {});

}  // namespace rs::synthetic
