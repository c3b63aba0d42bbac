#include "tests/bench/scenes/group_builder.hpp"

#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <cmath>

namespace rs::synthetic {
namespace {

using glm::vec2;
using glm::vec3;

// Repeated square roots of the magnitude, with the sign. Square roots are exactly rounded on every machine, unlike
// powers.
float repeated_root(float value, int roots) {
    float size = std::abs(value);
    for (int i = 0; i < roots; ++i) size = std::sqrt(size);
    return std::copysign(size, value);
}

}  // namespace

void GroupBuilder::set_frame(vec3 origin, float turn_rad) {
    frame_ = {origin, rotation({0, 1, 0}, turn_rad)};
}

capture::Mesh& GroupBuilder::mesh_of(int material) {
    for (capture::Mesh& mesh : group_.meshes) {
        if (mesh.material == material) return mesh;
    }
    group_.meshes.emplace_back();
    group_.meshes.back().name = group_.name;
    group_.meshes.back().material = material;
    return group_.meshes.back();
}

void GroupBuilder::place(capture::Mesh& mesh, std::size_t first) const {
    mesh.uvs.resize(mesh.positions.size(), vec2(0.0F));
    for (std::size_t i = first; i < mesh.positions.size(); ++i) {
        mesh.positions[i] = frame_.point(mesh.positions[i]);
        mesh.normals[i] = frame_.direction(mesh.normals[i]);
    }
}

void GroupBuilder::box(int material, vec3 low, vec3 high) {
    const vec3 x{high.x - low.x, 0, 0}, y{0, high.y - low.y, 0}, z{0, 0, high.z - low.z};
    sheet(material, low + z, x, y);
    sheet(material, low + x + z, -z, y);
    sheet(material, low + x, -x, y);
    sheet(material, low, z, y);
    sheet(material, low, x, z);
    sheet(material, low + y + z, x, -z);
}

void GroupBuilder::sheet(int material, vec3 corner, vec3 right, vec3 up, int columns, int rows, float uv_per_m) {
    Grid grid(columns, rows);
    grid.positions.clear();
    grid.uvs.clear();
    const float width = glm::length(right) * uv_per_m, height = glm::length(up) * uv_per_m;
    const vec3 normal = glm::normalize(glm::cross(right, up));
    for (int row = 0; row <= rows; ++row) {
        for (int column = 0; column <= columns; ++column) {
            const float s = static_cast<float>(column) / static_cast<float>(columns);
            const float t = static_cast<float>(row) / static_cast<float>(rows);
            grid.positions.push_back(corner + right * s + up * t);
            grid.uvs.emplace_back(s * width, t * height);
            grid.normals.push_back(normal);
        }
    }
    surface(material, std::move(grid));
}

void GroupBuilder::strip(int material, std::span<const vec3> a, std::span<const vec3> b) {
    RS_CHECK(a.size() == b.size() && a.size() >= 2);
    Grid grid(static_cast<int>(a.size()) - 1, 1);
    grid.positions.assign(a.begin(), a.end());
    grid.positions.insert(grid.positions.end(), b.begin(), b.end());
    grid.uvs.clear();
    for (const vec3& p : grid.positions) grid.uvs.emplace_back(0.5F * (p.x + p.z), 0.5F * p.y);
    surface(material, std::move(grid));
}

void GroupBuilder::surface(int material, Grid grid) {
    capture::Mesh& mesh = mesh_of(material);
    const std::size_t first = mesh.positions.size();
    append_grid(mesh, std::move(grid));
    place(mesh, first);
}

void GroupBuilder::lathe(int material, vec3 foot, std::span<const vec2> profile, int segments) {
    capture::Mesh& mesh = mesh_of(material);
    const std::size_t first = mesh.positions.size();
    append_lathe(mesh, profile, {.segments = segments});
    for (std::size_t i = first; i < mesh.positions.size(); ++i) mesh.positions[i] += foot;
    place(mesh, first);
}

void GroupBuilder::tube(int material, std::span<const vec3> path, float radius, int sides) {
    capture::Mesh& mesh = mesh_of(material);
    const std::size_t first = mesh.positions.size();
    append_tube(mesh, path, std::span<const float>(&radius, 1), {.sides = sides});
    place(mesh, first);
}

void GroupBuilder::cushion(int material, vec3 low, vec3 high, int roots, int columns, int rows) {
    Grid grid(columns, rows, true);
    grid.positions.clear();
    grid.uvs.clear();
    const vec3 middle = 0.5F * (low + high), half = 0.5F * (high - low);
    for (int row = 0; row <= rows; ++row) {
        const float polar = portable::kPiF * (static_cast<float>(row) / static_cast<float>(rows) - 0.5F);
        const float ring = row == 0 || row == rows ? 0.0F : repeated_root(portable::cos(polar), roots);
        const float height = row == 0 ? -1.0F : row == rows ? 1.0F : repeated_root(portable::sin(polar), roots);
        for (int column = 0; column <= columns; ++column) {
            const float turn = portable::kTwoPiF * static_cast<float>(column % columns) / static_cast<float>(columns);
            const vec3 unit{ring * repeated_root(portable::sin(turn), roots), height,
                            ring * repeated_root(portable::cos(turn), roots)};
            grid.positions.push_back(middle + half * unit);
            grid.uvs.emplace_back(static_cast<float>(column) / static_cast<float>(columns),
                                  static_cast<float>(row) / static_cast<float>(rows));
        }
    }
    surface(material, std::move(grid));
}

void GroupBuilder::blades(int material, const Blades& like, std::int64_t triangles, Random& random) {
    RS_CHECK(triangles == 0 || triangles >= 6);
    constexpr int kTrianglesPerBlade = 9;  // odd
    const Frame frame = frame_facing(like.foot, like.up, {0, 0, 1});
    capture::Mesh& mesh = mesh_of(material);
    while (triangles > 0) {
        std::int64_t of_this = kTrianglesPerBlade;
        if (triangles < 2 * kTrianglesPerBlade) of_this = triangles % 2 == 1 ? triangles : 3;
        triangles -= of_this;
        const float turn = random.uniform(0.0F, portable::kTwoPiF);
        const float away = std::sqrt(random.uniform());
        const vec3 outwards = frame.direction(portable::around(turn, 1.0F, 0.0F));
        Strand strand;
        strand.root = like.foot + outwards * (away * like.spread);
        strand.direction = glm::normalize(like.up + outwards * (0.7F * away));
        strand.bend = (outwards - 0.6F * like.up) * (like.bend * random.uniform(0.6F, 1.2F));
        strand.side = glm::normalize(glm::cross(like.up, outwards));
        strand.length = like.length * random.uniform(0.7F, 1.1F);
        strand.width = like.width * random.uniform(0.8F, 1.2F);
        const std::size_t first = mesh.positions.size();
        append_strand(mesh, strand, static_cast<int>((of_this + 1) / 2));
        place(mesh, first);
    }
}

}  // namespace rs::synthetic
