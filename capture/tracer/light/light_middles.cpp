// The part of LightSet that takes each source for a point.
#include "capture/tracer/light/directions.hpp"
#include "capture/tracer/light/light_set.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {

void LightSet::gather_glow(const Mesh& mesh) {
    const Material& material = scene_.materials[static_cast<std::size_t>(mesh.material)];
    Glow glow;
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

void LightSet::visit_middles(const glm::vec3& position, const std::function<void(const LightSample&)>& visit) const {
    int number = -1;
    const auto give = [&](LightSample light) {
        light.source = number;
        visit(light);
    };
    for (const Source& source : sources_) {
        ++number;
        if (source.kind == SourceKind::environment || source.kind == SourceKind::emitters) continue;
        if (!(estimate(source, position) > 0.0F)) continue;
        if (source.kind == SourceKind::area) {
            const Area& area = areas_[source.index];
            const glm::vec2 middle = area.round ? glm::vec2(0.0F) : glm::vec2(0.5F);
            if (const auto light = sample_area(area, position, 1.0F, middle)) give(*light);
        } else if (const auto light = sample_light(lights_[source.index], position, 1.0F)) {
            give(*light);
        }
    }
    for (const Glow& glow : glows_) {
        ++number;
        const glm::vec3 to_light = glow.middle - position;
        const float distance2 = glm::dot(to_light, to_light);
        if (!(distance2 > 0.0F)) continue;
        const float distance = std::sqrt(distance2);
        const glm::vec3 direction = to_light / distance;
        const bool flat = glm::length(glow.mean_normal) > 0.5F * glow.area;
        // A closed surface shows a quarter of its area to any side, on average.
        float facing = -glm::dot(direction, glow.mean_normal);
        if (glow.two_sided) facing = std::abs(facing);
        if (!flat) facing = glow.area / 4.0F;
        const float clear = flat ? distance : distance - glow.radius;
        if (!(facing > 0.0F) || !(clear > 0.0F)) continue;
        // As an area of that size which faces the place; never larger than half of what it sees.
        give({direction, clear, glow.emission, std::max(distance2 / facing, 1.0F / kPiF), false});
    }
}

}  // namespace rs::capture
