#include "compositor/scene/scene.hpp"

#include "rayspace/api/types/check.hpp"

namespace rs::compositor {

namespace {

void include(BoundingBox& all, const BoundingBox& box) {
    if (box.empty()) return;
    all.include(box.lowest);
    all.include(box.highest);
}

}  // namespace

bool is_traced(const GeometryNode& node) {
    if (node.mesh->topology != Topology::kTriangles) return false;
    if (!is_blended(node.material)) return true;
    return node.material.lit && surface_of(node.material).kind == rs::SurfaceKind::glass && is_closed(*node.mesh);
}

void copy_lights(const Scene& from, Scene& to) {
    RS_CHECK(from.geometry.size() == to.geometry.size());
    to.lights = from.lights;
    to.environment = from.environment;
    to.navigation.headlight = from.navigation.headlight;
    for (std::size_t n = 0; n < to.geometry.size(); ++n) to.geometry[n].lights = from.geometry[n].lights;
}

BoundingBox bounds_of(const Scene& scene) {
    return bounds_from(scene, 0, scene.objects.size());
}

BoundingBox bounds_from(const Scene& scene, std::size_t first_geometry, std::size_t first_object) {
    BoundingBox all;
    for (std::size_t i = first_geometry; i < scene.geometry.size(); ++i) {
        const GeometryNode& node = scene.geometry[i];
        include(all, bounds_of(*node.mesh).moved(node.world_from_node));
    }
    for (std::size_t i = first_object; i < scene.objects.size(); ++i) {
        const Similarity place = world_from_node(scene.objects[i].chain);
        include(all, {place.translation - glm::dvec3(place.scale), place.translation + glm::dvec3(place.scale)});
    }
    return all;
}

}  // namespace rs::compositor
