#pragma once
// Instances as meshes of their own: what moves, made to stand still.

#include "capture/tracer/scene/scene.hpp"

namespace rs::capture {

// A mesh where the matrix puts it, which must be affine and have an inverse. Outer sides stay outer where it mirrors.
Mesh placed_mesh(const Mesh& mesh, const glm::dmat4& world_from_mesh);

// The same scene at time 0 without parts and instances.
Scene flattened(Scene scene);

}  // namespace rs::capture
