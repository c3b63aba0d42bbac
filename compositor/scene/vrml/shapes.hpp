#pragma once
// Geometry of shapes: X3D nodes -> VRML97 nodes -> checked lists -> triangles. Private to the VRML and X3D readers.

#include "compositor/scene/mesh.hpp"
#include "compositor/scene/vrml/graph.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rs::compositor::vrml {

/// Converts X3D's additional shapes: triangle sets, strips, fans, quads and rectangles become an IndexedFaceSet, line
/// sets an IndexedLineSet; the alpha of colours is dropped. Pure; thread-safe.
/// \return null if the node is a VRML97 one already; otherwise a copy.
NodePointer to_vrml97(const Node& geometry);

/// Lists of an IndexedFaceSet or IndexedLineSet. Faces of less than 3 corners and lines of less than 2 points are
/// removed.
struct IndexedLists {
    std::vector<std::int32_t> coord;  // each face ends with -1
    /// Same layout as `coord`, or one entry per face; empty if the node has no matching list.
    std::vector<std::int32_t> color;
    std::vector<std::int32_t> normal;
    std::vector<std::int32_t> texture;
};

/// Result of check_shape().
struct ShapeCheck {
    std::string fault;                  // reason if the shape cannot be drawn; else empty
    std::vector<std::string> unusable;  // fields (color, normal, texCoord) with mismatching sizes, which are ignored
    double work = 0;                    // estimated cost of triangulation in units of about 10 ns
    bool empty = false;                 // valid, but nothing is to be drawn
    IndexedLists lists;
};
/// Validates and completes the lists of a geometry node before triangulation by Coin, which does not check them: every
/// index in range, colours, normals and texture coordinates for every corner or face. Pure; thread-safe.
ShapeCheck check_shape(const Node& geometry);

/// Triangulates a geometry node.
/// \param check result of check_shape() without fault.
/// \return null if there is nothing to draw.
/// Thread-safe; calls are serialised, since Coin has global state. Only triangulate.cpp uses Coin.
std::shared_ptr<const Mesh> triangulate(const Node& geometry, const ShapeCheck& check);

}  // namespace rs::compositor::vrml
