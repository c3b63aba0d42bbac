#pragma once
// What surrounds a scene and how it is to be looked at: background, fog, viewpoints, navigation. Colours are linear
// light.

#include "compositor/scene/material.hpp"
#include "rayspace/light/light.hpp"

#include <glm/glm.hpp>

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

// Seen at infinity (ISO/IEC 14772-1, 6.5): the sky's colours from the zenith down, over them the ground's from the
// nadir up, over them images on a cube.
struct Background {
    std::vector<glm::vec3> sky{{0.62F, 0.68F, 0.74F}};  // at least one: the zenith's; then one for each angle
    std::vector<double> sky_angles_rad;                 // from the zenith, not decreasing; beyond the last, its colour
    std::vector<glm::vec3> ground;                      // none, or the nadir's and one for each angle
    std::vector<double> ground_angles_rad;              // from the nadir
    // Front (seen along -Z), back, left, right, top, bottom; null where there is none.
    std::array<std::shared_ptr<const SceneTexture>, 6> images;
    glm::dmat3 world_from_background{1.0};  // rotation
};
// Of sky and ground, looking along `direction` in scene coordinates, of any length but 0.
glm::vec3 background_colour(const Background& background, const glm::dvec3& direction);

// Light from all around, far away: a latitude-longitude map whose middle column is -Z and whose row 0 is +Y, u growing
// towards +X. Traced renderers take it as it is; raster as its mean.
struct EnvironmentLight {
    std::shared_ptr<const Image<RgbaF>> pixels;  // not null; linear light, finite, not negative
    float scale = 1;
    float turn_rad = 0;  // about Y
    bool seen = false;   // stands behind everything, where it is traced
};

// As a list of lights has it.
struct EnvironmentEntry {
    std::filesystem::path file{};
    double scale = 1;  // 0..kStrongest
    double turn_deg = 0;
    bool seen = false;
    std::shared_ptr<const Image<RgbaF>> pixels{};  // what is in the file; not null

    bool operator==(const EnvironmentEntry&) const = default;
};

enum class FogKind { kLinear, kExponential };
struct Fog {
    FogKind kind = FogKind::kLinear;
    glm::vec3 colour{1};
    double visibility = 1;  // the distance at which nothing else is seen, > 0, scene units
};

struct Viewpoint {
    std::string description;
    glm::dmat4 world_from_camera{1.0};    // rigid; columns are right, up, back, centre
    double field_of_view_rad = 0.785398;  // full angle along the image's shorter side
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
