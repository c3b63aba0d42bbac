#include "capture/tracer/integrator/toon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rs::capture {

namespace {

constexpr float kInfiniteDistance = std::numeric_limits<float>::infinity();

// Point `index` of a shifted low-discrepancy sequence in the unit square (M. Roberts, "The Unreasonable Effectiveness
// of Quasirandom Sequences", 2018).
glm::vec2 quasirandom_point(const glm::vec2& shift, int index) {
    return glm::min(glm::fract(shift + static_cast<float>(index) * glm::vec2(0.75487767F, 0.56984029F)),
                    glm::vec2(0x1.fffffep-1F));
}

}  // namespace

ToonTracer::ToonTracer(const LightTransport& transport, IrradianceMap irradiance, const glm::vec3& ambient,
                       int max_depth, ToonStyle style, float pixel_rad)
    : WhittedTracer(transport, std::move(irradiance), ambient, max_depth, style.shadow_rays > 0),
      style_(std::move(style)),
      edges_(transport.rays(), style_, pixel_rad),
      isotropic_irradiance_(kPiF * luminance(ambient)) {
    find_sky_light();
}

void ToonTracer::find_sky_light() {
    constexpr int kDirections = 2048;
    constexpr float kGoldenAngle_rad = 2.39996323F;
    constexpr float kMinDifference = 0.05F;
    float smallest = kInfiniteDistance, largest = 0;
    for (int i = 0; i < kDirections; ++i) {
        const float height = 1.0F - 2.0F * (static_cast<float>(i) + 0.5F) / kDirections;
        const float across = std::sqrt(1.0F - height * height), turn = kGoldenAngle_rad * static_cast<float>(i);
        const glm::vec3 normal(across * std::cos(turn), height, across * std::sin(turn));
        const float irradiance = luminance(this->irradiance().at(normal));
        smallest = std::min(smallest, irradiance);
        if (!(irradiance > largest)) continue;
        largest = irradiance;
        sky_direction_ = normal;
    }
    // A nearly uniform environment has no direction.
    if (largest - smallest < kMinDifference * largest) smallest = largest;
    sky_irradiance_ = largest - smallest;
    isotropic_irradiance_ += smallest;
}

bool ToonTracer::trace(const glm::vec3& origin, const glm::vec3& direction, float time, Sampler& sampler,
                       glm::vec3& radiance) const {
    const bool met = WhittedTracer::trace(origin, direction, time, sampler, radiance);
    if (style_.steps == ToonStyle::Steps::colour) radiance = quantise_colour(radiance);
    radiance = glm::min(radiance, glm::vec3(style_.brightness));
    return met;
}

bool ToonTracer::shade(const LightTransport::Vertex& vertex, const Ray& ray, Sampler& sampler,
                       glm::vec3& radiance) const {
    if (edges_.is_near_edge(vertex.point, ray.segment.direction, ray.previous_distance)) {
        radiance += style_.brightness * style_.edge_colour;
        return false;
    }
    if (style_.steps == ToonStyle::Steps::colour) return WhittedTracer::shade(vertex, ray, sampler, radiance);
    // Metals are treated as mirrors.
    if (vertex.surface.is_specular() || transport().model_of(vertex.point).kind == SurfaceKind::metal) return true;
    radiance += style_.brightness * style_.tone(intensity(vertex, sampler)) * vertex.surface.colour();
    return true;
}

glm::vec3 ToonTracer::quantise_colour(const glm::vec3& radiance) const {
    const float largest = max_component(radiance);
    if (!(largest > 0.0F)) return radiance;
    return radiance * (style_.brightness * style_.tone(largest / style_.brightness) / largest);
}

float ToonTracer::intensity(const LightTransport::Vertex& vertex, Sampler& sampler) const {
    const float through = transport().model_of(vertex.point).translucency;
    float lit = 0, sum = 0;
    glm::vec3 net_irradiance(0.0F);
    const auto add = [&](float strength, const glm::vec3& direction, float distance, const ShadowCasters& casters) {
        sum += strength;
        net_irradiance += strength * direction;
        const float cosine = glm::dot(vertex.frame.normal, direction);
        const float received = cosine > 0.0F ? (1.0F - through) * cosine : -through * cosine;
        if (!(received > 0.0F)) return;
        const glm::vec3 start = vertex.ray_origin(direction, cosine > 0.0F);
        if (!transport().rays().occluded(start, direction, distance * (1.0F - 1e-4F), vertex.point.time, casters))
            lit += strength * received;
    };
    if (sky_irradiance_ > 0.0F) add(sky_irradiance_, sky_direction_, kInfiniteDistance, {});
    const LightSet& lights = transport().lights();
    const LitPoint at = vertex.lit_point();
    const int rays = std::max(style_.shadow_rays, 1);
    const glm::vec2 shift = style_.shadow_rays > 0 ? sampler.next_2d() : glm::vec2(0.0F);
    for (int ray = 0; ray < rays; ++ray) {
        const auto point_on_light = [&] { return quasirandom_point(shift, ray); };
        for (std::size_t i = 0; i < lights.light_count(); ++i) {
            const auto light =
                style_.shadow_rays > 0 ? lights.sample_point(i, at, point_on_light) : lights.sample_centre(i, at);
            if (!light || (light->delta && ray > 0)) continue;
            const float share = light->delta ? 1.0F : 1.0F / static_cast<float>(rays);
            add(share * luminance(light->radiance) / light->pdf, light->direction, light->distance, light->casters);
        }
    }
    const float isotropic =
        isotropic_irradiance_ + kPiF * luminance(transport().scene().scopes.ambient(vertex.point.light_group));
    const float largest = std::max(glm::length(net_irradiance), 0.5F * sum) + isotropic;
    return largest > 0.0F ? (lit + isotropic) / largest : 0.0F;
}

}  // namespace rs::capture
