#pragma once
// A camera that shows all objects, for when nobody says where to look from. Pure; thread-safe.

#include "compositor/scene/camera_path.hpp"
#include "compositor/viewer/placed_object.hpp"

#include <vector>

namespace rs::compositor {

// Looks at the middle of the objects from the +Z side, from so far that each of them fits into the picture (width over
// height = `aspect`), and at the mean elevation of their first rings, where their pictures were taken. `fov_x_rad` is
// the full horizontal angle.
CameraPose framing_pose(const std::vector<PlacedObject>& objects, double fov_x_rad, double aspect);

}  // namespace rs::compositor
