#include "capture/tracer/scene/scene_transform.hpp"

#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
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

namespace {

template <class Element>
void append(std::vector<Element>& to, std::vector<Element> from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace

void add_surroundings(Scene& object, Scene room, const glm::dmat4& object_from_room) {
    RS_CHECK(!object.has_surroundings());
    room = flattened(std::move(room));
    const auto materials = static_cast<int>(object.materials.size());
    const auto textures = static_cast<int>(object.textures.size());
    const auto reliefs = static_cast<int>(object.reliefs.size());
    for (Material& material : room.materials) {
        if (material.texture >= 0) material.texture += textures;
        if (material.emission_texture >= 0) material.emission_texture += textures;
        if (material.relief >= 0) material.relief += reliefs;
    }
    for (const Mesh& mesh : room.meshes) {
        object.meshes.push_back(transform_mesh(mesh, object_from_room));
        object.meshes.back().material += materials;
    }
    object.first_surrounding_material = materials;
    append(object.materials, std::move(room.materials));
    append(object.textures, std::move(room.textures));
    append(object.reliefs, std::move(room.reliefs));
}

namespace {

constexpr double kMinWidth = 1e-6;  // per radius

template <class Visit>
void for_each_used_vertex(const Scene& scene, Visit visit) {
    for (const Mesh& mesh : scene.meshes) {
        for (const glm::uvec3& t : mesh.triangles) {
            for (int corner = 0; corner < 3; ++corner) visit(glm::dvec3(mesh.positions[t[corner]]));
        }
    }
}

}  // namespace

Result<double> normalise_meshes(Scene& scene, ObjectCentre origin) {
    glm::dvec3 lower(std::numeric_limits<double>::infinity());
    glm::dvec3 upper(-std::numeric_limits<double>::infinity());
    for_each_used_vertex(scene, [&](const glm::dvec3& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    });
    const glm::dvec3 centre = origin == ObjectCentre::bounding_box ? 0.5 * (lower + upper) : glm::dvec3(0);
    double radius = 0;
    double width = 0;  // from the Y axis
    for_each_used_vertex(scene, [&](const glm::dvec3& p) {
        radius = std::max(radius, glm::length(p - centre));
        width = std::max(width, std::hypot(p.x - centre.x, p.z - centre.z));
    });
    if (!(radius > 0.0) || !std::isfinite(radius)) {
        return Error{scene.name + ": the meshes have no size; use a mesh with triangles"};
    }
    if (!(width > kMinWidth * radius)) {
        return Error{scene.name +
                     ": the meshes have no width: all their vertices lie on a vertical line; repair the mesh"};
    }
    for (Mesh& mesh : scene.meshes) {
        for (glm::vec3& p : mesh.positions) p = glm::vec3((glm::dvec3(p) - centre) / radius);
    }
    double object_radius = 0;
    for_each_used_vertex(scene,
                         [&](const glm::dvec3& p) { object_radius = std::max(object_radius, std::hypot(p.x, p.z)); });
    return object_radius;
}

double ground_height(const Scene& scene) {
    double lowest = std::numeric_limits<double>::infinity();
    for_each_used_vertex(scene, [&](const glm::dvec3& p) { lowest = std::min(lowest, p.y); });
    return lowest;
}

}  // namespace rs::capture
