#pragma once
// A rectangular grid of points becomes part of a mesh: the one way in which lathe, sweep, ellipsoid and petal make
// triangles.

#include "capture/tracer/scene/scene.hpp"

#include <vector>

namespace rs::synthetic {

// Vertex (column i, row j), 0 <= i <= columns, 0 <= j <= rows, stands at index j * (columns + 1) + i. Seen from the
// front (the side that normals point to) columns run to the right and rows upwards.
struct Grid {
    Grid(int columns_, int rows_, bool wrap_columns_ = false, bool wrap_rows_ = false);

    int columns;        // >= 1, faces across
    int rows;           // >= 1, faces up
    bool wrap_columns;  // the last column of points is the first again, with its own texture coordinates
    bool wrap_rows;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec3> normals;  // empty = computed from the faces, smooth across the wraps and at poles

    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns + 1) + static_cast<std::size_t>(column);
    }
};

// Triangles of which two corners coincide exactly (at poles) are left out; nothing else is, so a closed grid stays
// closed. Cost: linear in the points.
void append_grid(capture::Mesh& mesh, Grid grid);

}  // namespace rs::synthetic
