#include "compositor/traced/traced_room.hpp"

#include "compositor/scene/normal_map.hpp"
#include "rayspace/base/parallel.hpp"
#include "rayspace/image/linear_light.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace rs::compositor {
namespace {

constexpr int kFloorCorners = 96;
constexpr int kFloorTexels = 64;  // of two squares

float luminance(const glm::vec3& colour) {
    return glm::dot(colour, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

capture::Texture linear_texture(const SceneTexture& from) {
    capture::Texture texture;
    texture.pixels = Image<RgbaF>(from.picture.width(), from.picture.height());
    texture.repeat_u = from.repeat_s;
    texture.repeat_v = from.repeat_t;
    for_each_index(from.picture.height(), 0, [&](std::int64_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < from.picture.width(); ++x) {
            const Rgba8 p = from.picture(x, y);
            texture.pixels(x, y) = {linear_from_srgb8(p.r), linear_from_srgb8(p.g), linear_from_srgb8(p.b),
                                    from.has_alpha ? static_cast<float>(p.a) / 255.0F : 1.0F};
        }
    });
    return texture;
}

capture::Material surface_of(const Material& from, const glm::vec3& vertex_colour) {
    capture::Material material;
    const bool replaced = from.texture && !from.texture->modulates;
    const glm::vec3 colour = glm::clamp(replaced ? glm::vec3(1) : from.diffuse, glm::vec3(0), glm::vec3(1));
    material.colour = colour;
    material.emission = glm::max(from.emissive, glm::vec3(0));
    if (!from.lit) {
        material.colour = glm::vec3(0);
        material.emission = colour * vertex_colour;
    } else if (luminance(from.specular) > 0) {
        material.kind = capture::SurfaceKind::glossy;
        const float exponent = from.shininess * 128;
        material.roughness = std::pow(2 / (exponent + 2), 0.25F);  // its square is GGX's alpha
    }
    return material;
}

capture::Mesh mesh_of(const GeometryNode& node) {
    capture::Mesh mesh;
    const glm::dmat3 turned = glm::transpose(glm::inverse(glm::dmat3(node.world_from_node)));
    const bool mirrors = glm::determinant(glm::dmat3(node.world_from_node)) < 0;
    for (const MeshVertex& vertex : node.mesh->vertices) {
        mesh.positions.emplace_back(node.world_from_node * glm::dvec4(vertex.position, 1));
        const glm::dvec3 normal = turned * glm::dvec3(vertex.normal);
        const double length = glm::length(normal);
        mesh.normals.emplace_back(length > 0 ? normal / length : glm::dvec3(0));
        mesh.uvs.emplace_back(node.material.texture_transform * glm::vec3(vertex.texture, 1));
        if (node.mesh->has_colours) mesh.colours.push_back(glm::max(glm::vec3(vertex.colour), glm::vec3(0)));
    }
    const std::vector<std::uint32_t>& indices = node.mesh->indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        mesh.triangles.emplace_back(indices[i], indices[i + (mirrors ? 2 : 1)], indices[i + (mirrors ? 1 : 2)]);
    }
    return mesh;
}

glm::vec3 mean_of(const std::vector<glm::vec3>& colours) {
    if (colours.empty()) return glm::vec3(1);
    glm::dvec3 sum(0);
    for (const glm::vec3& colour : colours) sum += colour;
    return glm::vec3(sum / static_cast<double>(colours.size()));
}

// Seen from above. The checker's fade at its rim is the raster renderer's.
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

}  // namespace

TracedRoom traced_room(const Scene& scene) {
    TracedRoom room;
    std::map<const SceneTexture*, int> textures;
    std::map<const NormalMap*, int> reliefs;
    for (std::size_t n = 0; n < scene.geometry.size(); ++n) {
        const GeometryNode& node = scene.geometry[n];
        if (node.mesh->topology != Topology::kTriangles || is_blended(node.material)) {
            ++room.left_to_raster;
            continue;
        }
        capture::Mesh mesh = mesh_of(node);
        mesh.name = "node " + std::to_string(n + 1);
        mesh.material = static_cast<int>(room.scene.materials.size());
        capture::Material material = surface_of(node.material, mean_of(mesh.colours));
        material.name = mesh.name;
        material.two_sided = node.mesh->two_sided;
        if (node.material.texture) {
            const auto [found, is_new] = textures.try_emplace(node.material.texture.get(), -1);
            if (is_new) {
                found->second = static_cast<int>(room.scene.textures.size());
                room.scene.textures.push_back(linear_texture(*node.material.texture));
            }
            material.texture = found->second;
            if (!node.material.lit) material.emission_texture = found->second;
        }
        if (node.material.normals && node.material.lit) {
            const NormalMap& map = *node.material.normals;
            const auto [found, is_new] = reliefs.try_emplace(&map, static_cast<int>(room.scene.reliefs.size()));
            if (is_new) room.scene.reliefs.push_back({"relief", map.directions, map.repeat_s, map.repeat_t});
            material.relief = found->second;
        }
        room.scene.materials.push_back(std::move(material));
        room.scene.meshes.push_back(std::move(mesh));
    }
    if (scene.floor) add_floor(*scene.floor, room.scene);
    if (scene.environment) {
        const EnvironmentLight& light = *scene.environment;
        room.scene.environment = {*light.pixels, light.scale, light.turn_rad};
    }
    for (const Light& light : scene.lights) {
        if (light.everywhere) {
            room.scene.lights.push_back(light);
        } else {
            ++room.without_own_lights;
        }
    }
    return room;
}

Light headlight_of(const glm::dvec3& forward) {
    Light light;
    light.towards = glm::normalize(forward);
    light.name = "headlight";
    return light;
}

}  // namespace rs::compositor
