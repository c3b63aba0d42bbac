#pragma once
// The projection of a frame, and what lies outside of it. Pure; thread-safe.

#include "compositor/scene/mesh.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

namespace rs::compositor {

// Depth of the near plane in scene units. Depth is stored as kNear / depth in floating point, whose relative precision
// is the same near and far: it may be small.
constexpr double kNear = 0.001;

// What a frame is seen from.
struct FrameView {
    Camera camera;
    glm::dmat4 clip_from_world{1.0};  // reversed depth with the far plane at infinity (gl/context.hpp)
};
FrameView view_of_frame(const Camera& camera);

// False only where nothing of the box can be in the picture.
bool may_be_seen(const BoundingBox& box_in_world, const FrameView& view);

}  // namespace rs::compositor
