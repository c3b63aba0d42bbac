#pragma once
// Triangulation of a rectangular grid of points, used by lathe, sweep, ellipsoid and petal.

#include "capture/tracer/scene/scene.hpp"

#include <vector>

namespace rs::synthetic {

// Vertex (column i, row j), 0 <= i <= columns, 0 <= j <= rows, has index j * (columns + 1) + i. Seen from the front
// (the side of the normals) columns run to the right and rows upwards.
struct Grid {
    Grid(int columns_, int rows_, bool wrap_columns_ = false, bool wrap_rows_ = false);

    int columns;        // >= 1, faces across
    int rows;           // >= 1, faces up
    bool wrap_columns;  // the last column of points repeats the first, with its own texture coordinates
    bool wrap_rows;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec3> normals;  // empty = computed from the faces, smooth across the wraps and at poles

    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns + 1) + static_cast<std::size_t>(column);
    }
};

// Appends the triangles except those with two identical corners (at poles), so that a closed grid stays closed. Linear
// time.
void append_grid(capture::Mesh& mesh, Grid grid);

}  // namespace rs::synthetic
