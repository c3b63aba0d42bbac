#pragma once
// Surroundings of a captured object: images show the object alone, lit by the room's lights and walls.

#include "capture/tracer/scene/scene.hpp"

#include <glm/glm.hpp>

namespace rs::capture {

/// Adds the meshes, materials and textures of `room` as surroundings of an object without surroundings.
/// \param object_from_room affine and invertible
void add_surroundings(Scene& object, Scene room, const glm::dmat4& object_from_room);

}  // namespace rs::capture
