#pragma once
// Cameras for a scene: at one of its viewpoints, or where all is seen, for when no place to look from is given. Pure;
// thread-safe.

#include "compositor/scene/camera_path.hpp"
#include "compositor/scene/mesh.hpp"
#include "compositor/scene/surroundings.hpp"
#include "compositor/viewer/residency/placed_object.hpp"

#include <vector>

namespace rs::compositor {

// Looks at the middle of the objects from the +Z side, from so far that each of them fits into the image (width over
// height = `aspect`), and at the mean elevation of their first rings, where their images were taken. `fov_x_rad` is
// the full horizontal angle.
CameraPose framing_pose(const std::vector<PlacedObject>& objects, double fov_x_rad, double aspect);

// Looks at the middle of the box, which is not empty, from the +Z side, from so far that all of it fits.
CameraPose framing_pose(const BoundingBox& bounds, double fov_x_rad, double aspect);

// An image of width x height px with square pixels. The viewpoint's field of view is that of the shorter side, as
// VRML97 requires.
Camera camera_at(const Viewpoint& viewpoint, int width, int height);

// The viewpoint's eye, and the point straight ahead at the distance of the middle of the box.
CameraPose pose_at(const Viewpoint& viewpoint, const BoundingBox& bounds);

}  // namespace rs::compositor
