#pragma once
// Validates and completes the lists of a geometry node before triangulation by Coin, which does not check them: every
// index in range, colours, normals and texture coordinates for every corner or face. Pure; thread-safe.

#include "compositor/scene/vrml/graph.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rs::compositor::vrml {

/// Lists of an IndexedFaceSet or IndexedLineSet. Faces of less than 3 corners and lines of less than 2 points are
/// removed.
struct IndexedLists {
    std::vector<std::int32_t> coord;  // each face ends with -1
    /// Same layout as `coord`, or one entry per face; empty if the node has no matching list.
    std::vector<std::int32_t> color;
    std::vector<std::int32_t> normal;
    std::vector<std::int32_t> texture;
};

struct ShapeCheck {
    std::string fault;                  // reason if the shape cannot be drawn; else empty
    std::vector<std::string> unusable;  // fields (color, normal, texCoord) with mismatching sizes, which are ignored
    double work = 0;                    // estimated cost of triangulation in units of about 10 ns
    bool empty = false;                 // valid, but nothing is to be drawn
    IndexedLists lists;
};
ShapeCheck check_shape(const Node& geometry);

}  // namespace rs::compositor::vrml
