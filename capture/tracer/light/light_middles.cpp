// The part of LightSet that takes each source for a point.
#include "capture/tracer/light/light_set.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"
#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {

void LightSet::gather_glow(const Mesh& mesh) {
    const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
    EmissiveMeshProxy glow;
    glow.two_sided = material.two_sided;
    glow.emission = material.emission;
    if (material.emission_texture >= 0) {
        glow.emission *= mean_colour(scene_.textures[static_cast<std::size_t>(material.emission_texture)]);
    }
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 corners[3] = {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
        const glm::vec3 normal = 0.5F * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const float area = glm::length(normal);
        glow.mean_normal += normal;
        glow.middle += area * (corners[0] + corners[1] + corners[2]) / 3.0F;
        glow.area += area;
    }
    if (!(glow.area > 0.0F)) return;
    glow.middle /= glow.area;
    for (const glm::uvec3& t : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            glow.radius = std::max(glow.radius, glm::distance(mesh.positions[t[corner]], glow.middle));
        }
    }
    glows_.push_back(glow);
}

std::optional<LightSample> LightSet::middle(std::size_t number, const glm::vec3& position) const {
    if (number >= sources_.size()) return glow(glows_[number - sources_.size()], position);
    const Source& source = sources_[number];
    if (source.kind == SourceKind::environment || source.kind == SourceKind::emitters) return std::nullopt;
    if (source.kind == SourceKind::distant) return sample_light(lights_[source.index], position, 1.0F);
    // Before a web is looked up.
    if (!(estimate(source, position) > 0.0F)) return std::nullopt;
    if (source.kind == SourceKind::local) return sample_light(lights_[source.index], position, 1.0F);
    return sample_area(areas_[source.index], position, 1.0F, glm::vec2(0.0F));
}

std::optional<LightSample> LightSet::glow(const EmissiveMeshProxy& glow, const glm::vec3& position) {
    const glm::vec3 to_light = glow.middle - position;
    const float distance2 = glm::dot(to_light, to_light);
    if (!(distance2 > 0.0F)) return std::nullopt;
    const float distance = std::sqrt(distance2);
    const glm::vec3 direction = to_light / distance;
    const bool flat = glm::length(glow.mean_normal) > 0.5F * glow.area;
    // A closed surface shows a quarter of its area to any side, on average.
    float facing = -glm::dot(direction, glow.mean_normal);
    if (glow.two_sided) facing = std::abs(facing);
    if (!flat) facing = glow.area / 4.0F;
    const float clear = flat ? distance : distance - glow.radius;
    if (!(facing > 0.0F) || !(clear > 0.0F)) return std::nullopt;
    // As an area of that size which faces the place; never larger than half of what it sees.
    return LightSample{direction, clear, glow.emission, std::max(distance2 / facing, 1.0F / kPiF), false};
}

std::optional<LightSample> LightSet::point(std::size_t number, const glm::vec3& position,
                                           const std::function<glm::vec2()>& draw) const {
    if (number >= sources_.size()) return std::nullopt;
    const Source& source = sources_[number];
    if (source.kind == SourceKind::environment || !(estimate(source, position) > 0.0F)) return std::nullopt;
    if (source.kind == SourceKind::area) {
        const Area& area = areas_[source.index];
        return sample_area(area, position, 1.0F, area.model->point(draw()));
    }
    if (source.kind != SourceKind::emitters) return sample_light(lights_[source.index], position, 1.0F);
    const Selection alone{position, source.power, 1.0F};  // drawn for certain
    const float which = draw().x;
    return sample_emitter(alone, which, draw());
}

}  // namespace rs::capture
