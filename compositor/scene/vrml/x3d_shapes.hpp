#pragma once
// Conversion of X3D's additional shapes to those of VRML97. Pure; private to the VRML and X3D readers.

#include "compositor/scene/vrml/graph.hpp"

namespace rs::compositor::vrml {

/// Triangle sets, strips, fans, quads and rectangles become an IndexedFaceSet, line sets an IndexedLineSet; the alpha
/// of colours is dropped.
/// \return null if the node is a VRML97 one already; otherwise a copy.
NodePointer to_vrml97(const Node& geometry);

}  // namespace rs::compositor::vrml
