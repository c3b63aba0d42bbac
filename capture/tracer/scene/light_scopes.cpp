#include "capture/tracer/scene/light_scopes.hpp"

#include "capture/tracer/scene/scene.hpp"

#include <algorithm>
#include <limits>

namespace rs::capture {

bool LightScopes::illuminates(std::uint32_t light, std::uint32_t group) const {
    return light == kUnscoped ||
           (!empty() && std::ranges::find(groups[group].lights, light) != groups[group].lights.end());
}

ScopeBounds bounds_of_scope(const Scene& scene, std::uint32_t light) {
    const LightScopes& scopes = scene.scopes;
    ScopeBounds bounds{glm::vec3(std::numeric_limits<float>::infinity()),
                       glm::vec3(-std::numeric_limits<float>::infinity())};
    const auto include = [&](const Mesh& mesh, const glm::dmat4& world_from_mesh) {
        for (const glm::uvec3& t : mesh.triangles) {
            for (int corner = 0; corner < 3; ++corner) {
                const glm::vec3 p(world_from_mesh * glm::dvec4(mesh.positions[t[corner]], 1));
                bounds.lower = glm::min(bounds.lower, p);
                bounds.upper = glm::max(bounds.upper, p);
            }
        }
    };
    for (std::size_t m = 0; m < scopes.of_mesh.size(); ++m) {
        if (scopes.illuminates(light, scopes.of_mesh[m])) include(scene.meshes[m], glm::dmat4(1));
    }
    for (std::size_t i = 0; i < scopes.of_instance.size(); ++i) {
        if (!scopes.illuminates(light, scopes.of_instance[i])) continue;
        const Instance& instance = scene.instances[i];
        for (const Mesh& mesh : scene.parts[instance.part].meshes) include(mesh, instance.world_from_part);
    }
    return bounds;
}

}  // namespace rs::capture
