#pragma once
// Handles of lights in an image: an icon per light, and for the selected one three axes for dragging and a point for
// aiming. Icons have a constant size on the screen; outlines of area lights have their true size.
//
//     point        a dot with its outline (LightModel::outline), or with rays
//     area         its outline, and an arrow in the emission direction
//     directional  an arrow to the centre of a dome in the upper part of the image, fixed to the camera
// Pure; thread-safe.

#include "compositor/lighting/light_edits.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace rs::compositor {

// A line, or a dot if both ends are equal, in scene coordinates.
struct HandleStroke {
    glm::dvec3 from{0};
    glm::dvec3 to{0};
    glm::vec3 colour{1};  // linear light
    float width_px = 1;
};

enum class HandlePart { kBody, kAxisX, kAxisY, kAxisZ, kAim };
inline constexpr HandlePart kAxisParts[] = {HandlePart::kAxisX, HandlePart::kAxisY, HandlePart::kAxisZ};

struct HandleHit {
    std::size_t light = 0;
    HandlePart part = HandlePart::kBody;
    bool operator==(const HandleHit&) const = default;
};

// Strokes of all handles; those of the selected light are last.
std::vector<HandleStroke> light_strokes(const LightingState& state, std::optional<std::size_t> selected,
                                        const std::optional<HandleHit>& under_pointer, const Camera& camera);

// Handle at a position in pixels; aim and axes of the selected light have priority.
std::optional<HandleHit> handle_at(const LightingState& state, std::optional<std::size_t> selected,
                                   const Camera& camera, const glm::dvec2& at_px);

// Position of a light's body handle; for directional lights on the dome.
glm::dvec3 handle_position(const LightEntry& entry, const Camera& camera);
// End of an axis of the selected light; directional lights have no axes.
glm::dvec3 axis_end(const LightEntry& entry, HandlePart axis, const Camera& camera);
// Position of the aim handle; none for point and directional lights.
std::optional<glm::dvec3> aim_position(const LightEntry& entry, const Camera& camera);
glm::dvec3 direction_of(HandlePart axis);

// Sphere at whose centre directional lights are aimed.
struct Dome {
    glm::dvec3 centre{0};
    double radius = 1;
};
Dome dome_of(const Camera& camera);

}  // namespace rs::compositor
