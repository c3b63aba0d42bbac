#pragma once
// Lights in scene coordinates, as VRML97 has them (ISO/IEC 14772-1, 4.6.6 and 4.14). Colours are linear light and may
// exceed 1.

#include "rayspace/base/conventions.hpp"

#include <glm/glm.hpp>

namespace rs::compositor {

enum class LightKind { kDirectional, kPoint, kSpot };

struct Light {
    LightKind kind = LightKind::kDirectional;
    glm::vec3 colour{1};           // intensity included
    glm::vec3 ambient{0};          // what it adds everywhere that it reaches, whatever the surface's direction
    glm::dvec3 towards{0, 0, -1};  // the direction in which the light travels, unit length; not of points
    // Points and spots only.
    glm::dvec3 location{0};
    glm::vec3 attenuation{1, 0, 0};  // falls off as 1 / max(a.x + a.y * d + a.z * d * d, 1) at distance d
    double radius = 100;             // no light beyond
    // Spots only: full light up to `beam_width_rad` from the axis, none beyond `cut_off_rad`.
    double beam_width_rad = kPi / 2;
    double cut_off_rad = kPi / 4;
    // Reaches all geometry; else only that whose GeometryNode::lights names it.
    bool everywhere = true;
};

}  // namespace rs::compositor
