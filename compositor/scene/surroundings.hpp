#pragma once
// What surrounds a scene and how it wants to be looked at: background, fog, viewpoints, navigation. Colours are linear
// light.

#include "compositor/scene/material.hpp"
#include "rayspace/base/conventions.hpp"

#include <glm/glm.hpp>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

// Lights in scene coordinates, as VRML97 has them (ISO/IEC 14772-1, 4.6.6 and 4.14). Colours are linear light and may
// exceed 1.

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

// Seen at infinity (ISO/IEC 14772-1, 6.5): the sky's colours from the zenith down, over them the ground's from the
// nadir up, over them pictures on a cube.
struct Background {
    std::vector<glm::vec3> sky{{0.62F, 0.68F, 0.74F}};  // at least one: the zenith's; then one for each angle
    std::vector<double> sky_angles_rad;                 // from the zenith, not decreasing; beyond the last, its colour
    std::vector<glm::vec3> ground;                      // none, or the nadir's and one for each angle
    std::vector<double> ground_angles_rad;              // from the nadir
    // Front (seen along -Z), back, left, right, top, bottom; null where there is none.
    std::array<std::shared_ptr<const SceneTexture>, 6> pictures;
    glm::dmat3 world_from_background{1.0};  // rotation
};
// Of sky and ground, looking along `direction` in scene coordinates, of any length but 0.
glm::vec3 background_colour(const Background& background, const glm::dvec3& direction);

enum class FogKind { kLinear, kExponential };
struct Fog {
    FogKind kind = FogKind::kLinear;
    glm::vec3 colour{1};
    double visibility = 1;  // the distance at which nothing else is seen, > 0, scene units
};

struct Viewpoint {
    std::string description;
    glm::dmat4 world_from_camera{1.0};    // rigid; columns are right, up, back, centre
    double field_of_view_rad = 0.785398;  // full angle along the picture's shorter side
};

struct Navigation {
    std::vector<std::string> types{"WALK", "ANY"};
    bool headlight = false;  // a white light that goes along with the viewer
    double speed = 1;        // scene units per second
    // Distance to walls, height of the eyes, height of a step.
    glm::dvec3 avatar{0.25, 1.6, 0.75};
    double visibility_limit = 0;  // 0: none
};

}  // namespace rs::compositor
