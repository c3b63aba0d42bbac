#include "datasets-synthetic/objects/object_assembly.hpp"

#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rs::synthetic {

int ObjectAssembly::add_texture(capture::Texture texture) {
    scene_.textures.push_back(std::move(texture));
    return static_cast<int>(scene_.textures.size()) - 1;
}

int ObjectAssembly::add_material(capture::Material material) {
    scene_.materials.push_back(std::move(material));
    return static_cast<int>(scene_.materials.size()) - 1;
}

capture::Mesh& ObjectAssembly::add_mesh(const std::string& name, int material) {
    RS_CHECK(material >= 0 && material < static_cast<int>(scene_.materials.size()));
    scene_.meshes.push_back({});
    scene_.meshes.back().name = name;
    scene_.meshes.back().material = material;
    return scene_.meshes.back();
}

capture::Scene ObjectAssembly::finish() && {
    std::erase_if(scene_.meshes, [](const capture::Mesh& mesh) { return mesh.triangles.empty(); });
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high = -low;
    for (const capture::Mesh& mesh : scene_.meshes) {
        for (const glm::vec3& p : mesh.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    const glm::vec3 middle = 0.5F * (low + high);
    float radius = 0.0F;
    for (const capture::Mesh& mesh : scene_.meshes) {
        for (const glm::vec3& p : mesh.positions) radius = std::max(radius, glm::length(p - middle));
    }
    RS_CHECK(radius > 0.0F);
    for (capture::Mesh& mesh : scene_.meshes) {
        for (glm::vec3& p : mesh.positions) p = (p - middle) / radius;
    }
    return std::move(scene_);
}

}  // namespace rs::synthetic
