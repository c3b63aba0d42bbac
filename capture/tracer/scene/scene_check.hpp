#pragma once
// Whether a scene can be rendered: every index valid, every number finite and in the range that scene.hpp states.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

namespace rs::capture {

// The error names the scene, the mesh, material, texture or light, and what is wrong with it. Environment pixels and
// texture pixels must be finite and not negative. A scene without triangles is renderable: it is empty.
Status check_scene(const Scene& scene);

// Of an instance's matrices, as Instance has it; the error names no instance.
Status check_placement(const Instance& instance);

}  // namespace rs::capture
