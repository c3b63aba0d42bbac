#pragma once
// Where the scene's camera stands and looks, frame by frame. Pure; thread-safe.

#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace rs::compositor {

struct CameraPose {
    glm::dvec3 eye{0, 0, 1};
    glm::dvec3 at{0, 0, 0};
};

// `frames` poses on a smooth curve (Catmull-Rom) through the keys, at equal steps of the curve's parameter. An open
// path begins at its first key and ends at its last; a closed one returns to its first key after the last frame.
struct CameraPath {
    std::vector<CameraPose> keys;  // at least one
    int frames = 1;                // >= 1
    bool closed = false;
    double fov_x_rad = radians(50);  // full horizontal angle
};
std::vector<CameraPose> poses_along(const CameraPath& path);

// `count` poses at even steps about the vertical through `pose.at`, the given one first.
std::vector<CameraPose> poses_around(const CameraPose& pose, int count);

}  // namespace rs::compositor
