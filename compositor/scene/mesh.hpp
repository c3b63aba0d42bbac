#pragma once
// Triangle meshes as the compositor draws them, and the shapes that a scene file may ask for.

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rs::compositor {

struct MeshVertex {
    glm::vec3 position;
    glm::vec3 normal;  // unit length
};
static_assert(sizeof(MeshVertex) == 24);

// Three indices make a triangle, seen from both sides. Lengths in the units of the node.
struct Mesh {
    std::vector<MeshVertex> vertices;
    std::vector<std::uint32_t> indices;
};

// Centred on the origin, as VRML97's Box. Sides > 0.
Mesh box_mesh(const glm::dvec3& size);

}  // namespace rs::compositor
