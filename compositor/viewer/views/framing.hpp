#pragma once
// Cameras for a scene: at a viewpoint, or framing everything if no viewpoint is given. Pure; thread-safe.

#include "compositor/scene/camera_path.hpp"
#include "compositor/scene/mesh.hpp"
#include "compositor/scene/surroundings.hpp"
#include "compositor/viewer/residency/placed_object.hpp"

#include <vector>

namespace rs::compositor {

/// Looks at the centre of the objects from the +Z side, at the mean elevation of their first capture rings, from a
/// distance at which every object fits into the image.
/// \param fov_x_rad full horizontal angle.
/// \param aspect width / height.
CameraPose framing_pose(const std::vector<PlacedObject>& objects, double fov_x_rad, double aspect);

/// Looks at the centre of the box from the +Z side, from a distance at which it fits. The box must not be empty.
CameraPose framing_pose(const BoundingBox& bounds, double fov_x_rad, double aspect);

/// Camera of width x height px with square pixels. The viewpoint's field of view applies to the shorter side, as VRML97
/// requires.
Camera camera_at(const Viewpoint& viewpoint, int width, int height);

/// Viewpoint of a camera with square pixels and a centred principal point: the inverse of camera_at().
Viewpoint viewpoint_of(const Camera& camera);

/// Eye of the viewpoint, and the point straight ahead at the distance of the box's centre.
CameraPose pose_at(const Viewpoint& viewpoint, const BoundingBox& bounds);

}  // namespace rs::compositor
