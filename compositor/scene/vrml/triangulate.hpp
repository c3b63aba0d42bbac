#pragma once
// Triangulation of geometry nodes into meshes. Private to the VRML reader.

#include "compositor/scene/mesh.hpp"
#include "compositor/scene/vrml/shape_lists.hpp"

#include <memory>

namespace rs::compositor::vrml {

/// \param check result of check_shape() without fault.
/// \return null if there is nothing to draw.
/// Thread-safe; calls are serialised, since Coin has global state. Coin is used in this source file only.
std::shared_ptr<const Mesh> triangulate(const Node& geometry, const ShapeCheck& check);

}  // namespace rs::compositor::vrml
