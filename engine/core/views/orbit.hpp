#pragma once
// Cameras for views of an object: an orbit like its capture, and a camera from an eye and a target.

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace rs::engine {

struct ViewShape {
    int width = 0;                    // px; 0 = as captured
    int height = 0;                   // px
    std::optional<double> fov_x_rad;  // full horizontal angle; empty = as captured
};

/// `count` cameras about the Y axis at even steps: the first captured camera, with its intrinsics scaled to `shape` so
/// that the whole captured frame fits, rotated about Y.
Result<std::vector<Camera>> orbit_cameras(const RaySpaceObject& object, int count, const ViewShape& shape);

/// Camera at `eye` that looks towards `at`, both in object radii. The field of view is as captured unless given.
Result<Camera> camera_from_eye(const RaySpaceObject& object, const glm::dvec3& eye, const glm::dvec3& at,
                               const ViewShape& shape);

}  // namespace rs::engine
