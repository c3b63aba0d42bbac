#pragma once
// Geometry nodes -> triangles, lines, points. Private to the VRML reader.

#include "compositor/scene/mesh.hpp"
#include "compositor/scene/vrml/shape_lists.hpp"

#include <memory>

namespace rs::compositor::vrml {

// The shape must have passed check_shape() without a fault. Null where there is nothing to draw. Thread-safe:
// Coin works for one call at a time, others wait. Its source is the only one that knows Coin.
std::shared_ptr<const Mesh> triangulate(const Node& geometry, const ShapeCheck& check);

}  // namespace rs::compositor::vrml
