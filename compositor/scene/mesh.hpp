#pragma once
// What the compositor draws: triangles, lines or points with normals, texture coordinates and colours, and the shapes
// that a scene file may request.

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rs::compositor {

struct MeshVertex {
    glm::vec3 position{0};
    glm::vec3 normal{0};    // unit length; 0 where there is no surface (lines, points): drawn unlit
    glm::vec2 texture{0};   // s to the right, t up: (0, 0) is the image's lower left corner
    glm::vec4 colour{1.0};  // linear light; replaces the material's diffuse colour where Mesh::has_colours
};
static_assert(sizeof(MeshVertex) == 48);

enum class Topology { kTriangles, kLines, kPoints };

// Three, two or one index for each triangle, line or point; triangles are counter-clockwise seen from their front.
// Lengths in the units of the node.
struct Mesh {
    std::vector<MeshVertex> vertices;
    std::vector<std::uint32_t> indices;
    Topology topology = Topology::kTriangles;
    bool two_sided = true;  // else triangles are seen from their front only
    bool has_colours = false;
};

// The smallest box that holds all vertices that an index names; empty where none does.
struct BoundingBox {
    glm::dvec3 lowest{1};
    glm::dvec3 highest{-1};
    [[nodiscard]] bool empty() const { return lowest.x > highest.x; }
    [[nodiscard]] glm::dvec3 middle() const { return (lowest + highest) * 0.5; }
    void include(const glm::dvec3& point);
    // The box that holds this box's corners where the matrix puts them.
    [[nodiscard]] BoundingBox moved(const glm::dmat4& matrix) const;
};
BoundingBox bounds_of(const Mesh& mesh);

// Centred on the origin, as VRML97's Box. Sides > 0.
Mesh box_mesh(const glm::dvec3& size);

}  // namespace rs::compositor
