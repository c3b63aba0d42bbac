#include "capture/tracer/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace rs::capture {

namespace {

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool is_radiance(const glm::vec3& v) {
    return finite(v) && v.x >= 0.0F && v.y >= 0.0F && v.z >= 0.0F;
}
bool in_range(float v, float low, float high) {
    return v >= low && v <= high;
}

using Problem = std::optional<std::string>;

Problem check_mesh(const Mesh& mesh, std::size_t material_count) {
    const std::string name = "mesh \"" + mesh.name + "\": ";
    if (mesh.material < 0 || static_cast<std::size_t>(mesh.material) >= material_count) {
        return name + "material " + std::to_string(mesh.material) + " does not exist; there are " +
               std::to_string(material_count);
    }
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) {
        return name + "the number of normals must be 0 or the number of vertices";
    }
    if (!mesh.uvs.empty() && mesh.uvs.size() != mesh.positions.size()) {
        return name + "the number of texture coordinates must be 0 or the number of vertices";
    }
    if (!mesh.colours.empty() && mesh.colours.size() != mesh.positions.size()) {
        return name + "the number of colours must be 0 or the number of vertices";
    }
    for (const glm::vec3& colour : mesh.colours) {
        if (!is_radiance(colour)) return name + "vertex colours must be finite and not negative";
    }
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (!finite(mesh.positions[i])) return name + "vertex " + std::to_string(i) + " is not finite; repair the mesh";
        if (!mesh.normals.empty() && !finite(mesh.normals[i])) {
            return name + "the normal of vertex " + std::to_string(i) + " is not finite; repair the mesh";
        }
        if (!mesh.uvs.empty() && !(std::isfinite(mesh.uvs[i].x) && std::isfinite(mesh.uvs[i].y))) {
            return name + "the texture coordinate of vertex " + std::to_string(i) + " is not finite; repair the mesh";
        }
    }
    for (const glm::uvec3& t : mesh.triangles) {
        if (std::max({t.x, t.y, t.z}) >= mesh.positions.size()) {
            return name + "a triangle refers to vertex " + std::to_string(std::max({t.x, t.y, t.z})) + ", there are " +
                   std::to_string(mesh.positions.size());
        }
    }
    return std::nullopt;
}

bool is_invertible(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(static_cast<float>(m[column][row]))) return false;
        }
    }
    const double lengths = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
    const bool affine = m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
    return affine && lengths > 1e-30 && std::abs(glm::determinant(glm::dmat3(m))) > 1e-9 * lengths;
}

Problem check_instances(const Scene& scene) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const std::string name = "instance " + std::to_string(i + 1) + ": ";
        if (instance.part >= scene.parts.size()) {
            return name + "part " + std::to_string(instance.part) + " does not exist; there are " +
                   std::to_string(scene.parts.size());
        }
        if (Status status = check_placement(instance); !status) return name + status.error().message;
    }
    return std::nullopt;
}

Problem check_material(const Material& material, std::size_t texture_count, std::size_t relief_count) {
    const std::string name = "material \"" + material.name + "\": ";
    for (const int texture : {material.texture, material.emission_texture}) {
        if (texture < -1 || (texture >= 0 && static_cast<std::size_t>(texture) >= texture_count)) {
            return name + "texture " + std::to_string(texture) + " does not exist";
        }
    }
    if (material.relief < -1 || (material.relief >= 0 && static_cast<std::size_t>(material.relief) >= relief_count)) {
        return name + "relief " + std::to_string(material.relief) + " does not exist";
    }
    if (!is_radiance(material.colour) || glm::any(glm::greaterThan(material.colour, glm::vec3(1.0F)))) {
        return name + "colour must be within 0..1";
    }
    if (!in_range(material.roughness, 0.0F, 1.0F)) return name + "roughness must be within 0..1";
    if (!in_range(material.ior, 1.0F, 10.0F)) return name + "ior must be within 1..10";
    if (!in_range(material.translucency, 0.0F, 1.0F)) return name + "translucency must be within 0..1";
    if (!is_radiance(material.emission)) return name + "emission must be finite and not negative";
    return std::nullopt;
}

bool has_valid_pixels(const Image<RgbaF>& pixels) {
    return std::ranges::all_of(pixels.pixels(), [](const RgbaF& p) {
        return is_radiance({p.r, p.g, p.b}) && std::isfinite(p.a);
    });
}

Problem check_lights(const Scene& scene) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        if (Status status = check_light(scene.lights[i]); !status) {
            return "light " + std::to_string(i + 1) + ": " + status.error().message;
        }
    }
    return std::nullopt;
}

Problem check_scopes(const Scene& scene) {
    const LightScopes& scopes = scene.scopes;
    if (scopes.empty()) return std::nullopt;
    if (scopes.of_mesh.size() != scene.meshes.size() || scopes.of_instance.size() != scene.instances.size()) {
        return "light scopes: each mesh and each instance must have a group";
    }
    const auto exists = [&](std::uint32_t group) { return group < scopes.groups.size(); };
    if (!std::ranges::all_of(scopes.of_mesh, exists) || !std::ranges::all_of(scopes.of_instance, exists)) {
        return "light scopes: a group does not exist";
    }
    for (const LightScopes::Group& group : scopes.groups) {
        if (!is_radiance(group.ambient)) return "light scopes: ambient light must be finite and not negative";
        for (const std::uint32_t light : group.lights) {
            if (light >= scene.lights.size()) return "light scopes: light " + std::to_string(light) + " does not exist";
        }
    }
    return std::nullopt;
}

Problem check_parts(const Scene& scene) {
    for (const Texture& texture : scene.textures) {
        if (texture.pixels.empty()) return "texture \"" + texture.name + "\" has no pixels";
        if (!has_valid_pixels(texture.pixels)) {
            return "texture \"" + texture.name + "\" has pixels that are negative or not finite";
        }
    }
    for (const Texture& relief : scene.reliefs) {
        const bool finite = std::ranges::all_of(relief.pixels.pixels(), [](const RgbaF& p) {
            return std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b);
        });
        if (relief.pixels.empty() || !finite) return "relief \"" + relief.name + "\" must have finite pixels";
    }
    for (const Material& material : scene.materials) {
        if (Problem problem = check_material(material, scene.textures.size(), scene.reliefs.size())) return problem;
    }
    for (const Mesh& mesh : scene.meshes) {
        if (Problem problem = check_mesh(mesh, scene.materials.size())) return problem;
    }
    for (const Part& part : scene.parts) {
        for (const Mesh& mesh : part.meshes) {
            if (Problem problem = check_mesh(mesh, scene.materials.size())) {
                return "part \"" + part.name + "\": " + *problem;
            }
        }
    }
    if (Problem problem = check_instances(scene)) return problem;
    if (Problem problem = check_lights(scene)) return problem;
    if (Problem problem = check_scopes(scene)) return problem;
    if (!in_range(scene.environment.scale, 0.0F, 1e9F)) return "environment: scale must be within 0..1e9";
    if (!std::isfinite(scene.environment.turn_rad)) return "environment: the turn must be finite";
    if (!has_valid_pixels(scene.environment.pixels)) return "environment: pixels must be finite and not negative";
    return std::nullopt;
}

}  // namespace

Status check_placement(const Instance& instance) {
    if (is_invertible(instance.world_from_part) && (!instance.at_close || is_invertible(*instance.at_close))) return {};
    return Error{"its matrix must be affine and finite and have an inverse; no axis may be scaled to 0"};
}

Status check_scene(const Scene& scene) {
    if (const Problem problem = check_parts(scene)) {
        return Error{(scene.name.empty() ? std::string("scene") : scene.name) + ": " + *problem};
    }
    return {};
}

}  // namespace rs::capture
