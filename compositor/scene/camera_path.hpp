#pragma once
// Camera poses along a path, frame by frame. Pure; thread-safe.

#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace rs::compositor {

struct CameraPose {
    glm::dvec3 eye{0, 0, 1};
    glm::dvec3 at{0, 0, 0};
};

/// Smooth curve (Catmull-Rom) through the keys, sampled at `frames` equal steps of its parameter. An open path begins
/// at the first key and ends at the last; a closed one returns to the first key after the last frame.
struct CameraPath {
    std::vector<CameraPose> keys;  // at least one
    int frames = 1;                // >= 1
    bool closed = false;
    double fov_x_rad = radians(50);  // full horizontal angle
};
std::vector<CameraPose> poses_along(const CameraPath& path);

/// `count` poses at equal angles about the vertical axis through `pose.at`, starting with `pose`.
std::vector<CameraPose> poses_around(const CameraPose& pose, int count);

}  // namespace rs::compositor
