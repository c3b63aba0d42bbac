#pragma once
// Axes of a ring of views. Turntable photos surround the object's Y axis. Views from above and below surround an axis
// across it, since the rays of an upright view must not be steep.

#include "rayspace/api/types/ray_space_object.hpp"
#include "rayspace/geometry/camera.hpp"

#include <glm/glm.hpp>

namespace rs {

/// The rotation as a matrix: multiplied by a vector in the object's axes it gives the vector in the ring's axes.
glm::dmat3 ring_from_object(const RingRotation& rotation);

/// The inverse of ring_from_object(), rounded. The matrix is a rotation.
RingRotation ring_rotation(const glm::dmat3& ring_from_object);

/// A camera of the object's axes in the ring's axes, and the inverse.
Camera in_ring_axes(Camera camera, const RingRotation& rotation);
Camera in_object_axes(Camera camera_in_ring, const RingRotation& rotation);

}  // namespace rs
