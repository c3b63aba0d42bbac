#pragma once
// A room around an object that is captured: images show the object alone, as the room's light and walls make it look.

#include "capture/tracer/scene/scene.hpp"

#include <glm/glm.hpp>

namespace rs::capture {

// Puts the meshes of `room` around the object; of the rest of it, materials and textures are taken along. The matrix is
// affine and has an inverse. There must be no surroundings yet.
void surround(Scene& object, Scene room, const glm::dmat4& object_from_room);

}  // namespace rs::capture
