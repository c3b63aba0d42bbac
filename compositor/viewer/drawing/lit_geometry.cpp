#include "compositor/viewer/drawing/lit_geometry.hpp"

#include "compositor/viewer/residency/object_relighting.hpp"

#include <utility>

namespace rs::compositor {
namespace {

// Caster bounds of the scene and of all displayed objects.
BoundingBox bounds_with_objects(const Scene& scene, const DisplayedNodes& nodes) {
    BoundingBox all = compositor::bounds_of_casters(scene);
    for (const DisplayedNode& node : nodes) {
        if (!node.object || node.object->object->bounds.empty()) continue;
        const Similarity& place = node.object->world_from_object;
        const glm::dvec3 reach(1.1 * place.scale);
        all.include(place.translation - reach);
        all.include(place.translation + reach);
    }
    return all;
}

// nullopt without shadows.
Result<std::optional<ShadowMaps>> create_maps(const Scene& scene, const DisplayedNodes& nodes, bool shadows) {
    if (!shadows) return std::optional<ShadowMaps>();
    RS_ASSIGN_OR_RETURN(auto made, ShadowMaps::create(plan_shadows(scene, bounds_with_objects(scene, nodes))));
    return std::optional<ShadowMaps>(std::move(made));
}

ShadowPlan plan_of(const std::optional<ShadowMaps>& maps) {
    return maps ? maps->plan() : ShadowPlan{};
}

}  // namespace

Result<LitGeometry> LitGeometry::create(const Scene& scene, const DisplayedNodes& nodes, bool shadows) {
    RS_ASSIGN_OR_RETURN(auto maps, create_maps(scene, nodes, shadows));
    EnvironmentIrradiance irradiance;
    const std::optional<IrradianceHarmonics> environment = irradiance.of(scene.environment);
    RS_ASSIGN_OR_RETURN(auto surfaces, SurfaceRenderer::create(scene, plan_of(maps), environment));
    LitGeometry lit(scene, std::move(irradiance), std::move(surfaces));
    RS_TRY(lit.light_floor(plan_of(maps), environment));
    lit.shadows_ = std::move(maps);
    return lit;
}

Status LitGeometry::light_floor(const ShadowPlan& plan, const std::optional<IrradianceHarmonics>& environment) {
    if (!scene_.floor) return {};
    if (floor_) return floor_->set_lights(scene_, plan, environment);
    RS_ASSIGN_OR_RETURN(auto floor, FloorRenderer::create(scene_, plan, environment));
    floor_.emplace(std::move(floor));
    return {};
}

// Rebuilds maps, surface tables and floor from scene_.
Status LitGeometry::rebuild_lighting(bool shadows, const DisplayedNodes& nodes) {
    RS_ASSIGN_OR_RETURN(auto maps, create_maps(scene_, nodes, shadows));
    const ShadowPlan plan = plan_of(maps);
    const std::optional<IrradianceHarmonics> environment = irradiance_.of(scene_.environment);
    RS_TRY(surfaces_.set_lights(scene_, plan, environment));
    RS_TRY(light_floor(plan, environment));
    if (maps && shadows_) maps->reuse_shells(*shadows_);
    shadows_ = std::move(maps);
    return {};
}

Status LitGeometry::set_lights(const Scene& scene, const DisplayedNodes& nodes) {
    copy_lights(scene, scene_);
    return rebuild_lighting(shadows(), nodes);
}

Status LitGeometry::set_shadows(bool shadows, const DisplayedNodes& nodes) {
    return shadows == this->shadows() ? Status() : rebuild_lighting(shadows, nodes);
}

Status LitGeometry::move(std::size_t node, const std::optional<glm::dmat4>& world_from_node) {
    if (surfaces_.is_at(node, world_from_node)) return {};
    if (shadows_) shadows_->invalidate(surfaces_.caster_bounds(node));
    RS_TRY(surfaces_.move(node, world_from_node));
    if (shadows_) shadows_->invalidate(surfaces_.caster_bounds(node));
    return {};
}

std::optional<IrradianceHarmonics> LitGeometry::irradiance_at(const glm::dvec3& position) {
    if (scene_.lights.empty() && !scene_.environment && scene_.navigation.headlight) return std::nullopt;
    IrradianceHarmonics irradiance = irradiance_of(scene_.lights, position);
    if (const auto environment = irradiance_.of(scene_.environment)) irradiance += *environment;
    return irradiance;
}

int LitGeometry::draw_shadows(const glm::dvec3& eye, const std::vector<std::optional<PlacedObject>>& objects) {
    const int drawn = shadows_->update(eye, objects, [&](const ShadowPass& pass) { surfaces_.draw_casters(pass); });
    shadows_->bind();
    surfaces_.set_cascades(shadows_->plan().cascade_rows());
    if (floor_) floor_->set_cascades(shadows_->plan().cascade_rows());
    return drawn;
}

}  // namespace rs::compositor
