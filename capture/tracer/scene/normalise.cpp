#include "capture/tracer/scene/normalise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rs::capture {

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
