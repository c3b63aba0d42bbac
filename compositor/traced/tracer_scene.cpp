#include "compositor/traced/tracer_scene.hpp"

#include "capture/tracer/scene/scene_transform.hpp"
#include "compositor/scene/light/scene_lights.hpp"
#include "compositor/scene/material.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/image/linear_light.hpp"
#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace rs::compositor {
namespace {

constexpr int kFloorCorners = 96;
constexpr int kFloorTexels = 64;  // two squares of the checker

capture::Texture linear_texture(const SceneTexture& from) {
    capture::Texture texture;
    texture.pixels = Image<RgbaF>(from.image.width(), from.image.height());
    texture.repeat_u = from.repeat_s;
    texture.repeat_v = from.repeat_t;
    for_each_index(from.image.height(), 0, [&](std::int64_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < from.image.width(); ++x) {
            const Rgba8 p = from.image(x, y);
            texture.pixels(x, y) = {linear_from_srgb8(p.r), linear_from_srgb8(p.g), linear_from_srgb8(p.b),
                                    from.has_alpha ? static_cast<float>(p.a) / 255.0F : 1.0F};
        }
    });
    return texture;
}

capture::Material traced_material(const Material& from, const glm::vec3& vertex_colour) {
    capture::Material material;
    if (!from.lit) {
        const bool replaced = from.texture && !from.texture->modulates;
        material.colour = glm::vec3(0);
        material.emission = glm::max(replaced ? glm::vec3(1) : from.diffuse, glm::vec3(0)) * vertex_colour;
        return material;
    }
    const SurfaceProperties surface = surface_of(from);
    material.kind = surface.kind;
    material.colour = surface.colour;
    material.roughness = surface.roughness;
    material.ior = surface.ior;
    material.emission = surface.emission;
    return material;
}

// In the node's coordinates.
capture::Mesh mesh_of(const GeometryNode& node) {
    capture::Mesh mesh;
    for (const MeshVertex& vertex : node.mesh->vertices) {
        mesh.positions.push_back(vertex.position);
        mesh.normals.push_back(vertex.normal);
        mesh.uvs.emplace_back(node.material.texture_transform * glm::vec3(vertex.texture, 1));
        if (node.mesh->has_colours) mesh.colours.push_back(glm::max(glm::vec3(vertex.colour), glm::vec3(0)));
    }
    const std::vector<std::uint32_t>& indices = node.mesh->indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        mesh.triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    }
    return mesh;
}

glm::vec3 mean_of(const std::vector<glm::vec3>& colours) {
    if (colours.empty()) return glm::vec3(1);
    glm::dvec3 sum(0);
    for (const glm::vec3& colour : colours) sum += colour;
    return glm::vec3(sum / static_cast<double>(colours.size()));
}

// Visible from above. Without the fade at the rim, which the raster renderer has.
void add_floor(const Floor& floor, capture::Scene& scene) {
    capture::Texture checker;
    checker.pixels = Image<RgbaF>(kFloorTexels, kFloorTexels);
    for (int y = 0; y < kFloorTexels; ++y) {
        for (int x = 0; x < kFloorTexels; ++x) {
            const bool same = (x < kFloorTexels / 2) == (y < kFloorTexels / 2);
            const glm::vec3 colour = same ? floor.colour_a : floor.colour_b;
            checker.pixels(x, y) = {colour.r, colour.g, colour.b, 1};
        }
    }
    capture::Material material;
    material.name = "floor";
    material.colour = glm::vec3(1);
    material.texture = static_cast<int>(scene.textures.size());
    material.two_sided = false;
    capture::Mesh mesh;
    mesh.name = "floor";
    mesh.material = static_cast<int>(scene.materials.size());
    const auto add_vertex = [&](double x, double z) {
        mesh.positions.emplace_back(x, floor.height, z);
        mesh.uvs.emplace_back(x / (2 * floor.square), -z / (2 * floor.square));
    };
    add_vertex(0, 0);
    for (unsigned i = 0; i < kFloorCorners; ++i) {
        const double turn = 2 * kPi * i / kFloorCorners;
        add_vertex(floor.radius * std::cos(turn), -floor.radius * std::sin(turn));
        mesh.triangles.emplace_back(0, i + 1, (i + 1) % kFloorCorners + 1);
    }
    scene.textures.push_back(std::move(checker));
    scene.materials.push_back(std::move(material));
    scene.meshes.push_back(std::move(mesh));
}

// Converts nodes and appends their materials and textures to the scene.
class NodeConverter {
public:
    explicit NodeConverter(capture::Scene& scene) : scene_(scene) {}

    // In the node's coordinates.
    capture::Mesh convert(const GeometryNode& node, const std::string& name) {
        capture::Mesh mesh = mesh_of(node);
        mesh.name = name;
        mesh.material = static_cast<int>(scene_.materials.size());
        capture::Material material = traced_material(node.material, mean_of(mesh.colours));
        material.name = name;
        material.two_sided = node.mesh->two_sided;
        if (node.material.texture) {
            material.texture = add_texture(*node.material.texture);
            if (!node.material.lit) material.emission_texture = material.texture;
        }
        if (node.material.lit && node.material.emission_texture) {
            material.emission_texture = add_texture(*node.material.emission_texture);
        }
        if (node.material.normals && node.material.lit) {
            const NormalMap& map = *node.material.normals;
            const auto [found, is_new] = reliefs_.try_emplace(&map, static_cast<int>(scene_.reliefs.size()));
            if (is_new) scene_.reliefs.push_back({"relief", map.directions, map.repeat_s, map.repeat_t});
            material.relief = found->second;
        }
        scene_.materials.push_back(std::move(material));
        return mesh;
    }

private:
    int add_texture(const SceneTexture& texture) {
        const auto [found, is_new] = textures_.try_emplace(&texture, static_cast<int>(scene_.textures.size()));
        if (is_new) scene_.textures.push_back(linear_texture(texture));
        return found->second;
    }

    capture::Scene& scene_;
    std::map<const SceneTexture*, int> textures_;
    std::map<const NormalMap*, int> reliefs_;
};

}  // namespace

std::vector<Light> traced_lights(const Scene& scene) {
    std::vector<Light> lights = scene.lights;
    const std::vector<bool> casts_shadows = lights_with_shadows(scene);
    for (std::size_t i = 0; i < lights.size(); ++i) lights[i].casts_shadows = casts_shadows[i];
    return lights;
}

capture::LightScopes traced_scopes(const Scene& scene) {
    capture::LightScopes scopes;
    if (std::ranges::all_of(scene.lights, &Light::everywhere)) return scopes;
    scopes.groups.emplace_back();
    std::map<std::vector<std::uint32_t>, std::uint32_t> known = {{{}, 0}};  // lights -> group
    for (const GeometryNode& node : scene.geometry) {
        if (!is_traced(node)) continue;
        const auto [group, is_new] = known.try_emplace(node.lights, static_cast<std::uint32_t>(scopes.groups.size()));
        if (is_new) {
            scopes.groups.push_back({node.lights});
            for (const std::uint32_t i : node.lights) scopes.groups.back().ambient += scene.lights[i].ambient;
        }
        (node.moving ? scopes.of_instance : scopes.of_mesh).push_back(group->second);
    }
    if (scene.floor) scopes.of_mesh.push_back(0);
    return scopes;
}

capture::Environment traced_environment(const Scene& scene) {
    if (!scene.environment) return {};
    return {*scene.environment->pixels, scene.environment->scale, scene.environment->turn_rad};
}

TracerScene make_tracer_scene(const Scene& scene) {
    TracerScene room;
    NodeConverter converter(room.scene);
    std::vector<std::pair<const GeometryNode*, std::size_t>> parts;  // first node of each part
    for (std::size_t n = 0; n < scene.geometry.size(); ++n) {
        const GeometryNode& node = scene.geometry[n];
        if (!is_traced(node)) {
            ++room.raster_only_nodes;
            continue;
        }
        if (!node.moving) {
            room.scene.meshes.push_back(capture::transform_mesh(
                converter.convert(node, "node " + std::to_string(n + 1)), node.world_from_node));
            continue;
        }
        const auto same = [&](const auto& known) {
            return known.first->mesh == node.mesh && known.first->material == node.material;
        };
        auto known = std::ranges::find_if(parts, same);
        if (known == parts.end()) {
            const std::string name = "node " + std::to_string(n + 1);
            known = parts.insert(known, {&node, room.scene.parts.size()});
            room.scene.parts.push_back({name, {converter.convert(node, name)}});
        }
        room.scene.instances.push_back({known->second, node.world_from_node});
        room.moving.push_back({*node.moving, node.world_from_node});
    }
    if (scene.floor) add_floor(*scene.floor, room.scene);
    room.scene.environment = traced_environment(scene);
    room.scene.lights = traced_lights(scene);
    room.scene.scopes = traced_scopes(scene);
    return room;
}

Light headlight_of(const glm::dvec3& forward) {
    Light light;
    light.towards = glm::normalize(forward);
    light.name = "headlight";
    return light;
}

}  // namespace rs::compositor
