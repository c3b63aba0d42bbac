#pragma once
// Meshes of triangles, lines or points with normals, texture coordinates and colours; basic shapes.

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rs::compositor {

struct MeshVertex {
    glm::vec3 position{0};
    glm::vec3 normal{0};    // unit length; 0 for lines and points, which are unlit
    glm::vec2 texture{0};   // s to the right, t upwards: (0, 0) is the lower left corner of the image
    glm::vec4 colour{1.0};  // linear light; replaces the material's diffuse colour if Mesh::has_colours
};
static_assert(sizeof(MeshVertex) == 48);

enum class Topology { kTriangles, kLines, kPoints };

/// Three, two or one index per triangle, line or point; front faces are counter-clockwise. Lengths in node units.
struct Mesh {
    std::vector<MeshVertex> vertices;
    std::vector<std::uint32_t> indices;
    Topology topology = Topology::kTriangles;
    bool two_sided = true;  // else only front faces are visible
    bool has_colours = false;
};

/// Axis-aligned bounding box of all indexed vertices; empty if there are none.
struct BoundingBox {
    glm::dvec3 lowest{1};
    glm::dvec3 highest{-1};
    [[nodiscard]] bool empty() const { return lowest.x > highest.x; }
    [[nodiscard]] glm::dvec3 middle() const { return (lowest + highest) * 0.5; }
    void include(const glm::dvec3& point);
    /// Bounding box of the transformed corners.
    [[nodiscard]] BoundingBox moved(const glm::dmat4& matrix) const;
};
BoundingBox bounds_of(const Mesh& mesh);

/// True for triangle meshes that enclose a volume: each edge has two triangles. Corners at the same
/// position, within 1e-5 of the mesh's size, are one.
bool is_closed(const Mesh& mesh);

/// True if the normals of a triangle point to its back: the sum of its corners' normals against its winding.
bool has_contradicting_normals(const Mesh& mesh);
/// Copy in which such triangles have reversed normals, with vertices of their own. Renderers then agree on lit sides:
/// the sides follow the winding, the curvature the normals.
Mesh with_normals_in_front(const Mesh& mesh);

/// Centred at the origin, like VRML97's Box. Sides > 0.
Mesh box_mesh(const glm::dvec3& size);

}  // namespace rs::compositor
