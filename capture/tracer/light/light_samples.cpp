// Sampling of LightSet with one sample per source, for one position or packets of sixteen surfaces.
#include "capture/tracer/light/light_set.hpp"
#include "capture/tracer/packets/light_lanes.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"
#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {

void LightSet::add_proxy(const Mesh& mesh) {
    const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
    EmissiveMeshProxy proxy;
    proxy.two_sided = material.two_sided;
    proxy.emission = material.emission;
    if (material.emission_texture >= 0) {
        proxy.emission *= mean_colour(scene_.textures[static_cast<std::size_t>(material.emission_texture)]);
    }
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 corners[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
        const glm::vec3 normal = 0.5F * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const float area = glm::length(normal);
        proxy.mean_normal += normal;
        proxy.centre += area * (corners[0] + corners[1] + corners[2]) / 3.0F;
        proxy.area += area;
    }
    if (!(proxy.area > 0.0F)) return;
    proxy.centre /= proxy.area;
    for (const glm::uvec3& t : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            proxy.radius = std::max(proxy.radius, glm::distance(mesh.positions[t[corner]], proxy.centre));
        }
    }
    proxies_.push_back(proxy);
}

std::optional<LightSample> LightSet::sample_centre(std::size_t index, const LitPoint& at) const {
    if (index >= sources_.size()) return sample_proxy(proxies_[index - sources_.size()], at.position);
    const Source& source = sources_[index];
    if (source.kind == SourceKind::environment || source.kind == SourceKind::emitters) return std::nullopt;
    // Cheap test before the look-up of a photometric web.
    if (!(estimate(source, at) > 0.0F)) return std::nullopt;
    if (source.kind == SourceKind::area) return sample_area(source, at.position, 1.0F, glm::vec2(0.0F));
    return sample_light(source, at.position, 1.0F);
}

std::optional<LightSample> LightSet::sample_proxy(const EmissiveMeshProxy& proxy, const glm::vec3& position) {
    const glm::vec3 to_light = proxy.centre - position;
    const float distance2 = glm::dot(to_light, to_light);
    if (!(distance2 > 0.0F)) return std::nullopt;
    const float distance = std::sqrt(distance2);
    const glm::vec3 direction = to_light / distance;
    const bool flat = glm::length(proxy.mean_normal) > 0.5F * proxy.area;
    // The mean projected area of a closed convex surface is a quarter of its area.
    float facing = -glm::dot(direction, proxy.mean_normal);
    if (proxy.two_sided) facing = std::abs(facing);
    if (!flat) facing = proxy.area / 4.0F;
    const float clear = flat ? distance : distance - proxy.radius;
    if (!(facing > 0.0F) || !(clear > 0.0F)) return std::nullopt;
    // As an area light of that size facing the position; its irradiance is at most that of a hemisphere.
    return LightSample{direction, clear, proxy.emission, std::max(distance2 / facing, 1.0F / kPiF), false};
}

std::optional<LightSample> LightSet::sample_point(std::size_t index, const LitPoint& at,
                                                  const std::function<glm::vec2()>& draw) const {
    if (index >= sources_.size()) return std::nullopt;
    const Source& source = sources_[index];
    if (source.kind == SourceKind::environment || !(estimate(source, at) > 0.0F)) return std::nullopt;
    if (source.kind == SourceKind::area) {
        return sample_area(source, at.position, 1.0F, areas_[source.index].model->point(draw()));
    }
    if (source.kind != SourceKind::emitters) return sample_light(source, at.position, 1.0F);
    const Selection certain{at, source.power, 1.0F};  // selection probability 1
    const float u_emitter = draw().x;
    return sample_emitter(certain, u_emitter, draw());
}

void set_lane(std::size_t lane, const LightSample& sample, LightLanes& incident) {
    incident.lit[lane] = -1;
    incident.direction.set(lane, sample.direction);
    incident.distance[lane] = sample.distance;
    incident.radiance.set(lane, sample.radiance);
    incident.pdf[lane] = sample.pdf;
    incident.delta = sample.delta;
    incident.casters = sample.casters;
}

bool LightSet::sample_centre(std::size_t index, const SurfaceLanes& surfaces, const MaskLanes& active,
                             LightLanes& incident) const {
    const Lanes3& positions = surfaces.near_start;
    MaskLanes reached = active;
    incident.casters = {};
    if (index < sources_.size()) {
        const Source& source = sources_[index];
        incident.casters = source.casters;
        if (source.casters.scoped_light != kUnscoped) {
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                if (active[lane] != 0 && !illuminates(source, surfaces.light_group[lane])) reached[lane] = 0;
            }
        }
        switch (source.kind) {
            case SourceKind::environment:
            case SourceKind::emitters:
                return false;
            case SourceKind::distant: {
                // Independent of the position.
                const auto light = sample_light(source, glm::vec3(0.0F), 1.0F);
                if (!light) return false;
                light_from_direction(light->direction, light->radiance, reached, incident);
                return true;
            }
            case SourceKind::local:
                if (model_of(lights_[source.index]).is_isotropic()) {
                    return light_from_point(points_[source.index], positions, reached, incident);
                }
                if (!cull_point_light(points_[source.index], surfaces, MaskLanes(reached), reached)) return false;
                break;
            case SourceKind::area: {
                const Area& area = areas_[source.index];
                return light_from_area({area.centre, area.normal, area.radiance, area.area, source.power}, positions,
                                       reached, incident);
            }
        }
    }
    incident.lit = {};
    bool any_lit = false;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (reached[lane] == 0) continue;
        const auto light = sample_centre(index, LitPoint{positions.at(lane), surfaces.light_group[lane]});
        if (!light) continue;
        set_lane(lane, *light, incident);
        any_lit = true;
    }
    return any_lit;
}

}  // namespace rs::capture
