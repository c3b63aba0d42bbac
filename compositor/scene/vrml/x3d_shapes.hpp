#pragma once
// Shapes that X3D has beside those of VRML97, as those. Pure; private to the readers of VRML and X3D.

#include "compositor/scene/vrml/graph.hpp"

namespace rs::compositor::vrml {

// Sets of triangles, strips, fans and quads, rectangles: an IndexedFaceSet. Line sets: an IndexedLineSet. Colours with
// opacity: without. Null where the node is one of VRML97 already. The node must outlive nothing: lists are copied.
NodePointer as_vrml97(const Node& geometry);

}  // namespace rs::compositor::vrml
