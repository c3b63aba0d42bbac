#include "compositor/scene/mesh.hpp"

namespace rs::compositor {

Mesh box_mesh(const glm::dvec3& size) {
    const glm::vec3 half = glm::vec3(size) * 0.5F;
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            glm::vec3 normal(0);
            glm::vec3 u(0);
            glm::vec3 v(0);
            normal[axis] = side;
            u[(axis + 1) % 3] = 1;
            v[(axis + 2) % 3] = 1;
            const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
            for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
                mesh.vertices.push_back({(normal + u * corner.x + v * corner.y) * half, normal});
            }
            for (const std::uint32_t index : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + index);
        }
    }
    return mesh;
}

}  // namespace rs::compositor
