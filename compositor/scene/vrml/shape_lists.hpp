#pragma once
// The lists of a geometry node, made to fit each other before Coin, which trusts them, cuts the shape into triangles:
// every index in range, every corner or face with its own colour, normal and texture coordinate. Pure; thread-safe.

#include "compositor/scene/vrml/graph.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rs::compositor::vrml {

// Of an IndexedFaceSet or IndexedLineSet. Faces of less than 3 corners and lines of less than 2 points are gone.
struct IndexedLists {
    std::vector<std::int32_t> coord;  // each face ends with -1
    // As `coord`, or one entry for each face; empty where the node gives none that fits.
    std::vector<std::int32_t> color;
    std::vector<std::int32_t> normal;
    std::vector<std::int32_t> texture;
};

struct ShapeCheck {
    std::string fault;                  // not empty where the shape cannot be drawn: why
    std::vector<std::string> unusable;  // fields (color, normal, texCoord) that do not fit; drawn without them
    double work = 0;                    // an estimate of what cutting it costs, about 10 ns each
    bool empty = false;                 // nothing is to be drawn, and that is no fault
    IndexedLists lists;
};
ShapeCheck check_shape(const Node& geometry);

}  // namespace rs::compositor::vrml
