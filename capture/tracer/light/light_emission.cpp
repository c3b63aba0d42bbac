// Photon emission of LightSet.
#include "capture/tracer/light/light_set.hpp"
#include "capture/tracer/scene/texture_lookup.hpp"
#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {

float LightSet::flux_of(const Source& source) const {
    const float radius = extent_of(source).radius;
    const float disc = kPiF * radius * radius;
    switch (source.kind) {
        case SourceKind::environment:
        case SourceKind::distant:
            return source.power * disc;
        case SourceKind::emitters:
            return static_cast<float>(emitter_power_) * kPiF;
        case SourceKind::area:
        case SourceKind::local:
            break;
    }
    const Light& light = lights_[source.kind == SourceKind::area ? areas_[source.index].light : source.index];
    // At a typical distance in the scene.
    const glm::vec3 flux(model_of(light).flux(light, 0.5 * static_cast<double>(extent_.radius)));
    return luminance(flux);
}

void LightSet::sum_flux() {
    flux_.clear();
    float sum = 0.0F;
    for (const Source& source : sources_) flux_.push_back(sum += flux_of(source));
    for (float& share : flux_) share /= sum;
}

std::optional<Photon> LightSet::emit(float u_source, const glm::vec2& u_place, const glm::vec2& u_direction) const {
    const auto found = std::ranges::upper_bound(flux_, u_source);
    const auto chosen = static_cast<std::size_t>(std::min(found, flux_.end() - 1) - flux_.begin());
    const float below = chosen > 0 ? flux_[chosen - 1] : 0.0F;
    const float probability = flux_[chosen] - below;
    if (!(probability > 0.0F)) return std::nullopt;
    const Source& source = sources_[chosen];
    switch (source.kind) {
        case SourceKind::environment: {
            const EnvironmentMap::Sample drawn = environment_.sample(u_direction);
            if (!(drawn.pdf > 0.0F)) return std::nullopt;
            return emit_distant(extent_, -drawn.direction,
                                environment_.radiance(drawn.direction) / (drawn.pdf * probability), u_place);
        }
        case SourceKind::distant: {
            const Light& light = lights_[source.index];
            Photon photon =
                emit_distant(extent_of(source), light.towards, light.colour * (kPiF / probability), u_place);
            photon.scoped_light = source.casters.scoped_light;
            return photon;
        }
        case SourceKind::area: {
            const Area& area = areas_[source.index];
            const glm::vec2 at = area.model->point(u_place);
            Photon photon{area.centre + area.half_u * at.x + area.half_v * at.y,
                          Frame(area.normal).to_world(sample_cosine_hemisphere(u_direction)), area.normal,
                          area.radiance * (kPiF * area.area / probability)};
            photon.scoped_light = source.casters.scoped_light;
            return photon;
        }
        case SourceKind::emitters:
            return emit_emitter(std::min((u_source - below) / probability, 0x1.fffffep-1F), probability, u_place,
                                u_direction);
        case SourceKind::local:
            return emit_local(source, probability, u_direction);
    }
    return std::nullopt;
}

Photon LightSet::emit_distant(const Extent& extent, const glm::vec3& direction, const glm::vec3& irradiance,
                              const glm::vec2& u) {
    const glm::vec2 at = sample_disc(u) * extent.radius;
    const Frame frame(direction);
    return {extent.centre - direction * (2.0F * extent.radius) + frame.tangent * at.x + frame.bitangent * at.y,
            direction, glm::vec3(0.0F), irradiance * (kPiF * extent.radius * extent.radius)};
}

std::optional<Photon> LightSet::emit_local(const Source& source, float probability, const glm::vec2& u) const {
    const Light& light = lights_[source.index];
    const auto drawn = model_of(light).sample(light, u);
    if (!drawn) return std::nullopt;
    Photon photon{};
    photon.origin = glm::vec3(light.location);
    photon.point = &light;
    photon.scoped_light = source.casters.scoped_light;
    photon.direction = drawn->direction;
    photon.inverse_pdf = drawn->inverse_pdf / probability;
    return photon;
}

std::optional<Photon> LightSet::emit_emitter(float u_emitter, float probability, const glm::vec2& u_place,
                                             const glm::vec2& u_direction) const {
    const auto found = std::ranges::upper_bound(emitters_, u_emitter, {}, &Emitter::cumulative);
    const Emitter& emitter = found == emitters_.end() ? emitters_.back() : *found;
    const EmitterPoint point = emitter_point(emitter, u_place);
    if (point.hole) return std::nullopt;
    const int material = emitter.mesh->material;
    const bool both = scene_.materials[static_cast<std::size_t>(material)].two_sided;
    glm::vec2 u = u_direction;
    glm::vec3 normal = point.normal;
    if (both) {
        if (u.x >= 0.5F) normal = -normal;
        u.x = std::min(2.0F * (u.x < 0.5F ? u.x : u.x - 0.5F), 0x1.fffffep-1F);
    }
    const float pdf =
        brightness_[static_cast<std::size_t>(material)] / static_cast<float>(emitter_power_) * probability;
    return Photon{point.position, Frame(normal).to_world(sample_cosine_hemisphere(u)), normal,
                  emission(material, point.uv) * ((both ? 2.0F : 1.0F) * kPiF / pdf)};
}

}  // namespace rs::capture
