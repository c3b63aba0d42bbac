#pragma once
// Converts instances to static meshes.

#include "capture/tracer/scene/scene.hpp"

namespace rs::capture {

/// Transforms a mesh by an invertible affine matrix. The winding is reversed for mirroring matrices, so that outer
/// sides stay outer.
Mesh transform_mesh(const Mesh& mesh, const glm::dmat4& world_from_mesh);

/// The scene at time 0 with meshes in place of parts and instances.
Scene flattened(Scene scene);

}  // namespace rs::capture
