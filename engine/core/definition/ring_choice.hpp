#pragma once
// Chooses the rings that render a view: the nearest one, and a second one where the viewpoint lies between two, with
// the weight by which their images are mixed (mix_rings.hpp). Floating point, before the normative arithmetic.
//
// A ring covers the directions of its views and of the gaps that have lines. Its distance from a viewpoint is the angle
// from the viewpoint's direction to the nearest one that it covers. From another distance than the ring's cameras the
// object's edge is seen along rays beside the viewpoint's direction; an arc must cover these, too. Arcs about other
// axes than the object's are used beyond the outermost rings about that axis only.

#include "rayspace/object/ray_space_object.hpp"

#include <glm/glm.hpp>

namespace rs::engine {

struct RingChoice {
    int nearest = 0;
    int second = -1;    // -1: none
    int weight_q8 = 0;  // of the second ring, 0..128
};

/// `viewpoint` is in the object's axes and radii. The object has at least one ring.
RingChoice choose_rings(const RaySpaceObject& object, const glm::dvec3& viewpoint);

}  // namespace rs::engine
