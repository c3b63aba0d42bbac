#include "capture/tracer/scene/flatten.hpp"

#include <utility>

namespace rs::capture {

Mesh transform_mesh(const Mesh& mesh, const glm::dmat4& world_from_mesh) {
    Mesh placed = mesh;
    for (glm::vec3& p : placed.positions) p = glm::vec3(world_from_mesh * glm::dvec4(p, 1));
    const glm::dmat3 turned = glm::transpose(glm::inverse(glm::dmat3(world_from_mesh)));
    for (glm::vec3& n : placed.normals) {
        const glm::dvec3 normal = turned * glm::dvec3(n);
        const double length = glm::length(normal);
        n = glm::vec3(length > 0 ? normal / length : glm::dvec3(0));
    }
    if (glm::determinant(glm::dmat3(world_from_mesh)) < 0) {
        for (glm::uvec3& t : placed.triangles) std::swap(t.y, t.z);
    }
    return placed;
}

Scene flattened(Scene scene) {
    for (const Instance& instance : scene.instances) {
        for (const Mesh& mesh : scene.parts[instance.part].meshes) {
            scene.meshes.push_back(transform_mesh(mesh, instance.world_from_part));
        }
    }
    scene.instances.clear();
    scene.parts.clear();
    return scene;
}

}  // namespace rs::capture
