#pragma once
// Lights as they are seen and grasped in an image: an icon for each, by kind, and on the selected one three axes to
// drag it along and a point to aim it by. Icons have the same size on the screen however far the light is; the outlines
// of areas are their own.
//
//     points       a dot with its outline (LightModel::outline), or with rays
//     areas        their outlines, and an arrow to where they shine
//     directional  an arrow to the middle of a dome that stands in the image's upper part, wherever one looks
// Pure; thread-safe.

#include "compositor/lighting/light_edits.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace rs::compositor {

// A line, or a dot where both ends are the same, in scene coordinates.
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

// Those of the selected light come last.
std::vector<HandleStroke> light_strokes(const LightingState& state, std::optional<std::size_t> selected,
                                        const std::optional<HandleHit>& under_pointer, const Camera& camera);

// What is grasped at a position in pixels: of the selected light its aim and its axes first.
std::optional<HandleHit> handle_at(const LightingState& state, std::optional<std::size_t> selected,
                                   const Camera& camera, const glm::dvec2& at_px);

// Where a light's handle is; of directional ones on the dome.
glm::dvec3 handle_place(const LightEntry& entry, const Camera& camera);
// The end of its axis; the selected light has them but where it is directional.
glm::dvec3 axis_end(const LightEntry& entry, HandlePart axis, const Camera& camera);
// Where its aim is grasped; nothing of points and directional lights.
std::optional<glm::dvec3> aim_place(const LightEntry& entry, const Camera& camera);
glm::dvec3 direction_of(HandlePart axis);

// A sphere whose middle directional lights are aimed at.
struct Dome {
    glm::dvec3 middle{0};
    double radius = 1;
};
Dome dome_of(const Camera& camera);

}  // namespace rs::compositor
