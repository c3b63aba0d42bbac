#include "capture/tracer/integrator/toon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rs::capture {

namespace {

constexpr float kFarAway = std::numeric_limits<float>::infinity();

// Place `index` of a sequence that fills the unit square evenly, shifted (M. Roberts, "The Unreasonable Effectiveness
// of Quasirandom Sequences", 2018).
glm::vec2 even_place(const glm::vec2& shift, int index) {
    return glm::min(glm::fract(shift + static_cast<float>(index) * glm::vec2(0.75487767F, 0.56984029F)),
                    glm::vec2(0x1.fffffep-1F));
}

}  // namespace

ToonTracer::ToonTracer(const LightTransport& transport, IrradianceMap irradiance, const glm::vec3& ambient,
                       int max_depth, ToonStyle style, float pixel_rad)
    : WhittedTracer(transport, std::move(irradiance), ambient, max_depth),
      style_(std::move(style)),
      edges_(transport.rays(), style_, pixel_rad),
      everywhere_(kPiF * luminance(ambient)) {
    find_sky();
}

void ToonTracer::find_sky() {
    constexpr int kDirections = 2048;
    constexpr float kGoldenAngle_rad = 2.39996323F;
    constexpr float kLeastDifference = 0.05F;
    float least = kFarAway, most = 0;
    for (int i = 0; i < kDirections; ++i) {
        const float height = 1.0F - 2.0F * (static_cast<float>(i) + 0.5F) / kDirections;
        const float across = std::sqrt(1.0F - height * height), turn = kGoldenAngle_rad * static_cast<float>(i);
        const glm::vec3 normal(across * std::cos(turn), height, across * std::sin(turn));
        const float irradiance = luminance(this->irradiance().at(normal));
        least = std::min(least, irradiance);
        if (!(irradiance > most)) continue;
        most = irradiance;
        sky_ = normal;
    }
    // What is even all around has no direction.
    if (most - least < kLeastDifference * most) least = most;
    of_sky_ = most - least;
    everywhere_ += least;
}

bool ToonTracer::trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
                       glm::vec3& radiance) const {
    const bool met = WhittedTracer::trace(origin, direction, time, sampler, radiance);
    radiance = glm::min(radiance, glm::vec3(style_.brightness));
    return met;
}

bool ToonTracer::shade(const LightTransport::Vertex& vertex, const Ray& ray, Sampler& sampler,
                       glm::vec3& radiance) const {
    if (edges_.near_edge(vertex.point, ray.segment.direction, ray.behind)) {
        radiance += style_.brightness * style_.edge_colour;
        return false;
    }
    // A metal shows what it mirrors, as a mirror does.
    if (vertex.surface.is_specular() || transport().model_of(vertex.point).kind == SurfaceKind::metal) return true;
    radiance += style_.brightness * style_.tone(intensity(vertex, sampler)) * vertex.surface.colour();
    return true;
}

float ToonTracer::intensity(const LightTransport::Vertex& vertex, Sampler& sampler) const {
    const float through = transport().model_of(vertex.point).translucency;
    float lit = 0, sum = 0;
    glm::vec3 towards(0.0F);
    const auto add = [&](float strength, const glm::vec3& direction, float distance) {
        sum += strength;
        towards += strength * direction;
        const float cosine = glm::dot(vertex.frame.normal, direction);
        const float received = cosine > 0.0F ? (1.0F - through) * cosine : -through * cosine;
        if (!(received > 0.0F)) return;
        const glm::vec3 start = vertex.start_of(direction, cosine > 0.0F);
        if (!transport().rays().occluded(start, direction, distance * (1.0F - 1e-4F), vertex.point.time))
            lit += strength * received;
    };
    if (of_sky_ > 0.0F) add(of_sky_, sky_, kFarAway);
    const LightSet& lights = transport().lights();
    const glm::vec3 place = vertex.start_of(vertex.point.geometric_normal, true);
    const int rays = std::max(style_.shadow_rays, 1);
    const glm::vec2 shift = style_.shadow_rays > 0 ? sampler.next_2d() : glm::vec2(0.0F);
    for (int ray = 0; ray < rays; ++ray) {
        const auto place_on_light = [&] { return even_place(shift, ray); };
        for (std::size_t i = 0; i < lights.light_count(); ++i) {
            const auto light =
                style_.shadow_rays > 0 ? lights.point(i, place, place_on_light) : lights.middle(i, place);
            if (!light || (light->delta && ray > 0)) continue;
            const float share = light->delta ? 1.0F : 1.0F / static_cast<float>(rays);
            add(share * luminance(light->radiance) / light->pdf, light->direction, light->distance);
        }
    }
    const float most = std::max(glm::length(towards), 0.5F * sum) + everywhere_;
    return most > 0.0F ? (lit + everywhere_) / most : 0.0F;
}

}  // namespace rs::capture
