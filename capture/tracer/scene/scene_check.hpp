#pragma once
// Validates scenes: every index valid, every number finite and within the range stated in scene.hpp.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

namespace rs::capture {

/// Checks a scene. Environment and texture pixels must be finite and not negative. A scene without triangles is valid.
/// \return an error that names the scene and the mesh, material, texture or light
Status check_scene(const Scene& scene);

/// Checks an instance's matrices (Instance); the error does not name the instance.
Status check_placement(const Instance& instance);

}  // namespace rs::capture
