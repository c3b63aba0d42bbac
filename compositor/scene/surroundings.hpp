#pragma once
// Background, environment light, fog, viewpoints and navigation of a scene. Colours are linear light.

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

/// Background at infinity (ISO/IEC 14772-1, 6.5): sky gradient, over it the ground gradient, over both the images of a
/// cube.
struct Background {
    std::vector<glm::vec3> sky{{0.62F, 0.68F, 0.74F}};  // at least one, at the zenith; then one per angle
    std::vector<double> sky_angles_rad;     // from the zenith, non-decreasing; the last colour continues beyond
    std::vector<glm::vec3> ground;          // empty, or the nadir's and one per angle
    std::vector<double> ground_angles_rad;  // from the nadir
    /// Front (seen along -Z), back, left, right, top, bottom; null if absent.
    std::array<std::shared_ptr<const SceneTexture>, 6> images;
    glm::dmat3 world_from_background{1.0};  // rotation
};
/// Colour of sky and ground along `direction` in scene coordinates, of any length but 0.
glm::vec3 background_colour(const Background& background, const glm::dvec3& direction);

/// Distant light from all directions: latitude-longitude map, centre column at -Z, row 0 at +Y, u increasing towards
/// +X. Traced renderers use the map; raster its irradiance by normal (light/irradiance_harmonics.hpp).
struct EnvironmentLight {
    std::shared_ptr<const Image<RgbaF>> pixels;  // not null; linear light, finite, not negative
    float scale = 1;
    float turn_rad = 0;  // about Y
    bool seen = false;   // background of images
};

/// Environment entry of a light list.
struct EnvironmentEntry {
    std::filesystem::path file{};
    double scale = 1;  // 0..kMaxLightStrength
    double turn_deg = 0;
    bool seen = false;
    std::shared_ptr<const Image<RgbaF>> pixels{};  // content of the file; not null

    bool operator==(const EnvironmentEntry&) const = default;
};

enum class FogKind { kLinear, kExponential };
struct Fog {
    FogKind kind = FogKind::kLinear;
    glm::vec3 colour{1};
    double visibility = 1;  // distance at which everything is fogged, > 0, scene units
};
/// Share of a surface's light that is left at a distance.
float fog_transmittance(const Fog& fog, double distance);

struct Viewpoint {
    std::string description;
    glm::dmat4 world_from_camera{1.0};    // rigid; columns are right, up, back, centre
    double field_of_view_rad = 0.785398;  // full angle along the shorter image side
};

struct Navigation {
    std::vector<std::string> types{"WALK", "ANY"};
    bool headlight = false;  // white light at the viewer
    double speed = 1;        // scene units per second
    /// Collision distance, eye height, step height.
    glm::dvec3 avatar{0.25, 1.6, 0.75};
    double visibility_limit = 0;  // 0: none
};

}  // namespace rs::compositor
