#pragma once
// Screen rectangle of a bounding cylinder; frame projection and culling. Pure; thread-safe.

#include "compositor/scene/mesh.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <optional>

namespace rs::compositor {

/// Pixels [x, x + width) x [y, y + height).
struct ScreenRectangle {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool operator==(const ScreenRectangle&) const = default;
};

/// Bounding rectangle of the cylinder's projection, clipped to the image.
/// \param camera in the cylinder's coordinates; may be inside of it.
/// \return nullopt if the cylinder is empty, behind the camera or off screen.
std::optional<ScreenRectangle> covering_rectangle(const BoundingCylinder& bound, const Camera& camera);

/// Near plane in scene units. Depth is stored as kNear / depth in floating point, whose relative precision is the same
/// near and far, so that kNear may be small.
constexpr double kNear = 0.001;

/// Camera and projection of a frame.
struct FrameView {
    Camera camera;
    glm::dmat4 clip_from_world{1.0};  // reversed depth, far plane at infinity (gl/context.hpp)
};
FrameView view_of_frame(const Camera& camera);

/// Conservative frustum test: false only if the box is outside of the projection's image.
/// \param perspective the projection is a perspective one with near plane kNear; otherwise orthographic.
bool can_be_visible(const BoundingBox& box_in_world, const glm::dmat4& clip_from_world, bool perspective = true);

}  // namespace rs::compositor
