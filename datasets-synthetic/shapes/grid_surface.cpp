#include "datasets-synthetic/shapes/surfaces.hpp"

#include "rayspace/api/types/check.hpp"

#include <utility>

namespace rs::synthetic {
namespace {

using glm::vec3;

// Makes the copies of a wrapped column or row bit-identical, which avoids hairline cracks in closed surfaces.
void copy_wrapped_positions(Grid& grid) {
    if (grid.wrap_columns) {
        for (int j = 0; j <= grid.rows; ++j)
            grid.positions[grid.index(grid.columns, j)] = grid.positions[grid.index(0, j)];
    }
    if (grid.wrap_rows) {
        for (int i = 0; i <= grid.columns; ++i)
            grid.positions[grid.index(i, grid.rows)] = grid.positions[grid.index(i, 0)];
    }
}

void share_normals(std::vector<vec3>& normals, std::size_t a, std::size_t b) {
    normals[a] += normals[b];
    normals[b] = normals[a];
}

void share_normals_at_pole(const Grid& grid, std::vector<vec3>& normals, int row) {
    const vec3 pole = grid.positions[grid.index(0, row)];
    vec3 sum{0.0F};
    for (int i = 0; i <= grid.columns; ++i) {
        if (grid.positions[grid.index(i, row)] != pole) return;
        if (i < grid.columns || !grid.wrap_columns) sum += normals[grid.index(i, row)];
    }
    for (int i = 0; i <= grid.columns; ++i) normals[grid.index(i, row)] = sum;
}

std::vector<vec3> smooth_normals(const Grid& grid) {
    std::vector<vec3> normals(grid.positions.size(), vec3{0.0F});
    // Weights normals by area: the length of a cross product is proportional to the face's area.
    const auto add_face = [&](std::size_t a, std::size_t b, std::size_t c) {
        const vec3 n = glm::cross(grid.positions[b] - grid.positions[a], grid.positions[c] - grid.positions[a]);
        normals[a] += n;
        normals[b] += n;
        normals[c] += n;
    };
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            // Averages both diagonals, which avoids a bias.
            const std::size_t a = grid.index(i, j);
            const std::size_t b = grid.index(i + 1, j);
            const std::size_t c = grid.index(i + 1, j + 1);
            const std::size_t d = grid.index(i, j + 1);
            add_face(a, b, c);
            add_face(a, c, d);
            add_face(a, b, d);
            add_face(b, c, d);
        }
    }
    if (grid.wrap_columns) {
        for (int j = 0; j <= grid.rows; ++j) share_normals(normals, grid.index(0, j), grid.index(grid.columns, j));
    }
    if (grid.wrap_rows) {
        for (int i = 0; i <= grid.columns; ++i) share_normals(normals, grid.index(i, 0), grid.index(i, grid.rows));
    } else {
        share_normals_at_pole(grid, normals, 0);
        share_normals_at_pole(grid, normals, grid.rows);
    }
    for (vec3& n : normals) {
        const float length = glm::length(n);
        n = length > 0.0F ? n / length : vec3{0, 1, 0};
    }
    return normals;
}

}  // namespace

Grid::Grid(int columns_, int rows_, bool wrap_columns_, bool wrap_rows_)
    : columns(columns_), rows(rows_), wrap_columns(wrap_columns_), wrap_rows(wrap_rows_) {
    RS_CHECK(columns >= 1 && rows >= 1);
    positions.resize(index(columns, rows) + 1);
    uvs.resize(positions.size());
}

void append_grid(capture::Mesh& mesh, Grid grid) {
    copy_wrapped_positions(grid);
    if (grid.normals.empty()) grid.normals = smooth_normals(grid);
    RS_CHECK(grid.normals.size() == grid.positions.size());

    const auto base = static_cast<unsigned>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), grid.positions.begin(), grid.positions.end());
    mesh.normals.insert(mesh.normals.end(), grid.normals.begin(), grid.normals.end());
    mesh.uvs.insert(mesh.uvs.end(), grid.uvs.begin(), grid.uvs.end());

    const auto add_triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
        const vec3 pa = grid.positions[a];
        const vec3 pb = grid.positions[b];
        const vec3 pc = grid.positions[c];
        if (pa == pb || pb == pc || pc == pa) return;
        mesh.triangles.emplace_back(base + static_cast<unsigned>(a), base + static_cast<unsigned>(b),
                                    base + static_cast<unsigned>(c));
    };
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            add_triangle(grid.index(i, j), grid.index(i + 1, j), grid.index(i + 1, j + 1));
            add_triangle(grid.index(i, j), grid.index(i + 1, j + 1), grid.index(i, j + 1));
        }
    }
}

}  // namespace rs::synthetic
