#pragma once
// The part of the screen that a bounding cylinder can cover. Pure; thread-safe.

#include "compositor/scene/mesh.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <optional>

namespace rs::compositor {

// Pixels [x, x + width) x [y, y + height).
struct ScreenRectangle {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool operator==(const ScreenRectangle&) const = default;
};

// Every pixel whose rays may meet the cylinder, cut to the camera's image; nothing where the cylinder is empty,
// behind the camera or off the screen. The camera is in the cylinder's coordinates and may stand inside of it.
std::optional<ScreenRectangle> covering_rectangle(const BoundingCylinder& bound, const Camera& camera);

// The projection of a frame, and what lies outside of it. Pure; thread-safe.

// Depth of the near plane in scene units. Depth is stored as kNear / depth in floating point, whose relative precision
// is the same near and far: it may be small.
constexpr double kNear = 0.001;

// What a frame is seen from.
struct FrameView {
    Camera camera;
    glm::dmat4 clip_from_world{1.0};  // reversed depth with the far plane at infinity (gl/context.hpp)
};
FrameView view_of_frame(const Camera& camera);

// False only where nothing of the box can be in the image of that projection. `perspective`: it is seen from a place,
// and what lies nearer than kNear is cut off; else along a direction.
bool may_be_seen(const BoundingBox& box_in_world, const glm::dmat4& clip_from_world, bool perspective = true);

}  // namespace rs::compositor
