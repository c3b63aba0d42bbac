#include "compositor/scene/mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

namespace rs::compositor {
namespace {

bool points_to_back(const Mesh& mesh, std::size_t first) {
    const auto corner = [&](std::size_t i) -> const MeshVertex& { return mesh.vertices[mesh.indices[first + i]]; };
    const glm::dvec3 origin(corner(0).position);
    const glm::dvec3 front =
        glm::cross(glm::dvec3(corner(1).position) - origin, glm::dvec3(corner(2).position) - origin);
    const glm::dvec3 sum = glm::dvec3(corner(0).normal) + glm::dvec3(corner(1).normal) + glm::dvec3(corner(2).normal);
    return glm::dot(sum, front) < 0;
}

}  // namespace

void BoundingBox::include(const glm::dvec3& point) {
    if (empty()) {
        lowest = highest = point;
        return;
    }
    lowest = glm::min(lowest, point);
    highest = glm::max(highest, point);
}

BoundingBox BoundingBox::moved(const glm::dmat4& matrix) const {
    BoundingBox result;
    if (empty()) return result;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) != 0 ? highest.x : lowest.x, (corner & 2) != 0 ? highest.y : lowest.y,
                           (corner & 4) != 0 ? highest.z : lowest.z);
        result.include(glm::dvec3(matrix * glm::dvec4(p, 1)));
    }
    return result;
}

BoundingBox bounds_of(const Mesh& mesh) {
    BoundingBox box;
    for (const std::uint32_t index : mesh.indices) box.include(mesh.vertices[index].position);
    return box;
}

bool is_closed(const Mesh& mesh) {
    if (mesh.topology != Topology::kTriangles) return false;
    // Corners closer than this share a cell of the grid, but for the few that its borders separate.
    constexpr double kCellOfSize = 1e-5;
    const BoundingBox box = bounds_of(mesh);
    const glm::dvec3 size = box.highest - box.lowest;
    const double cell = std::max({size.x, size.y, size.z}) * kCellOfSize;
    if (box.empty() || !(cell > 0)) return false;
    std::map<std::array<std::int64_t, 3>, int> corners;
    std::map<std::pair<int, int>, int> edges;  // uses in the order of the pair, less those in the other order
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::array<int, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 at = (glm::dvec3(mesh.vertices[mesh.indices[i + k]].position) - box.lowest) / cell;
            const std::array<std::int64_t, 3> key{std::llround(at.x), std::llround(at.y), std::llround(at.z)};
            triangle[k] = corners.try_emplace(key, static_cast<int>(corners.size())).first->second;
        }
        if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const int from = triangle[k], to = triangle[(k + 1) % 3];
            edges[std::minmax(from, to)] += from < to ? 1 : -1;
        }
    }
    return !edges.empty() && std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; });
}

bool has_contradicting_normals(const Mesh& mesh) {
    if (mesh.topology != Topology::kTriangles) return false;
    for (std::size_t first = 0; first + 2 < mesh.indices.size(); first += 3) {
        if (points_to_back(mesh, first)) return true;
    }
    return false;
}

Mesh with_normals_in_front(const Mesh& mesh) {
    Mesh turned = mesh;
    if (mesh.topology != Topology::kTriangles) return turned;
    std::map<std::uint32_t, std::uint32_t> reversed;  // index of the reversed copy of a vertex
    for (std::size_t first = 0; first + 2 < mesh.indices.size(); first += 3) {
        if (!points_to_back(mesh, first)) continue;
        for (std::size_t i = first; i < first + 3; ++i) {
            const auto next = static_cast<std::uint32_t>(turned.vertices.size());
            const auto [copy, is_new] = reversed.try_emplace(mesh.indices[i], next);
            if (is_new) {
                MeshVertex vertex = mesh.vertices[mesh.indices[i]];
                vertex.normal = -vertex.normal;
                turned.vertices.push_back(vertex);
            }
            turned.indices[i] = copy->second;
        }
    }
    return turned;
}

Mesh box_mesh(const glm::dvec3& size) {
    const glm::vec3 half = glm::vec3(size) * 0.5F;
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            glm::vec3 normal(0);
            glm::vec3 u(0);
            glm::vec3 v(0);
            normal[axis] = side;
            u[(axis + 1) % 3] = side;
            v[(axis + 2) % 3] = 1;
            const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
            for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                MeshVertex vertex;
                vertex.position = (normal + u * corner.x + v * corner.y) * half;
                vertex.normal = normal;
                vertex.texture = corner * 0.5F + 0.5F;
                mesh.vertices.push_back(vertex);
            }
            for (const std::uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + index);
        }
    }
    return mesh;
}

}  // namespace rs::compositor
