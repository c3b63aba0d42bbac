#include "capture/tracer/integrator/light_probe.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace rs::capture {
namespace {

RayImage all_directions(const glm::dvec3& position, int width) {
    return {
        width, width / 2, position, {0, 0, -1}, [width](double x, double y) { return probe_direction(x, y, width); }};
}

// Solid angle of a pixel in row y.
double solid_angle(int y, int width) {
    const double step = 2 * kPi / width;
    return (std::cos(y * step) - std::cos((y + 1) * step)) * 2 * kPi / width;
}

// Light from one direction.
struct Incident {
    glm::dvec3 direction;  // unit, towards the light
    glm::vec3 irradiance;  // of a surface that faces it
};

// Scoped lights reach positions within the bounds of their scope.
bool reaches(const Tracer& tracer, std::uint32_t index, const glm::dvec3& position) {
    return tracer.lights()[index].everywhere || tracer.scope_bounds(index).contains(glm::vec3(position));
}

bool is_light_visible(const Tracer& tracer, std::uint32_t index, const glm::dvec3& position,
                      const glm::dvec3& direction, double distance) {
    const Light& light = tracer.lights()[index];
    return tracer.is_unoccluded(position, direction, distance,
                                {light.casts_shadows, light.everywhere ? kUnscoped : index});
}

// nullopt for area lights and those that do not light the position.
std::optional<Incident> incident_light(const Tracer& tracer, std::uint32_t index, const glm::dvec3& position) {
    const Light& light = tracer.lights()[index];
    const glm::vec3 irradiance = irradiance_at(light, position);
    if (irradiance == glm::vec3(0) || !reaches(tracer, index, position)) return std::nullopt;
    const bool distant = model_of(light).form == LightForm::kDistant;
    const glm::dvec3 way = distant ? -light.towards : light.location - position;
    const double distance = glm::length(way);
    const double reach = distant ? std::numeric_limits<double>::infinity() : distance;
    if (!is_light_visible(tracer, index, position, way / distance, reach)) return std::nullopt;
    return Incident{way / distance, irradiance};
}

void add_light(std::uint32_t index, const Tracer& tracer, const glm::dvec3& position, Image<RgbaF>& map) {
    const std::optional<Incident> incident = incident_light(tracer, index, position);
    if (!incident) return;
    const glm::dvec3& direction = incident->direction;
    const int width = map.width();
    const double turns = 0.5 + std::atan2(direction.x, -direction.z) / (2 * kPi);
    const double polar = std::acos(std::clamp(direction.y, -1.0, 1.0)) / kPi;
    const int x = std::clamp(static_cast<int>(turns * width), 0, width - 1);
    const int y = std::clamp(static_cast<int>(polar * map.height()), 0, map.height() - 1);
    const glm::vec3 radiance = incident->irradiance / static_cast<float>(solid_angle(y, width));
    RgbaF& pixel = map(x, y);
    pixel = {pixel.r * pixel.a + radiance.r, pixel.g * pixel.a + radiance.g, pixel.b * pixel.a + radiance.b, 1};
}

void add_area_light(std::uint32_t index, const Tracer& tracer, const glm::dvec3& position,
                    IrradianceHarmonics& irradiance) {
    constexpr int kPointsAcross = 8;
    const Light& light = tracer.lights()[index];
    if (!reaches(tracer, index, position)) return;
    const glm::dvec3 normal = glm::normalize(glm::cross(light.half_u, light.half_v));
    const double area = area_of(light) / (kPointsAcross * kPointsAcross);  // of one point
    for (int i = 0; i < kPointsAcross * kPointsAcross; ++i) {
        const glm::vec2 u(glm::vec2(i % kPointsAcross, i / kPointsAcross) + 0.5F);
        const glm::dvec2 at(model_of(light).point(u / static_cast<float>(kPointsAcross)));
        const glm::dvec3 way = light.location + at.x * light.half_u + at.y * light.half_v - position;
        const double distance2 = glm::dot(way, way);
        const double distance = std::sqrt(distance2);
        const double facing = -glm::dot(way, normal) / distance;
        if (!(facing > 0)) continue;
        const glm::dvec3 direction = way / distance;
        if (!is_light_visible(tracer, index, position, direction, distance)) continue;
        irradiance.add_direction(direction, light.colour * static_cast<float>(area * facing / distance2));
    }
}

}  // namespace

glm::dvec3 probe_direction(double x, double y, int width) {
    const double phi = 2 * kPi * (x / width - 0.5);
    const double polar = 2 * kPi * y / width;
    return {std::sin(polar) * std::sin(phi), std::cos(polar), -std::sin(polar) * std::cos(phi)};
}

std::int64_t light_probe_steps(const LightProbeOptions& options) {
    return Tracer::step_count(all_directions({}, options.width));
}

Image<RgbaF> light_probe(const Tracer& tracer, const glm::dvec3& position, const LightProbeOptions& options,
                         Progress* progress) {
    RS_CHECK(options.width >= 2 && options.width % 2 == 0);
    RenderOptions render;
    render.samples_per_pixel = options.samples_per_pixel;
    render.max_bounces = options.max_bounces;
    render.show_areas = true;
    render.show_environment = true;
    Image<RgbaF> map = tracer.render(all_directions(position, options.width), render, progress).image;
    for (std::uint32_t i = 0; i < tracer.lights().size(); ++i) add_light(i, tracer, position, map);
    return map;
}

IrradianceHarmonics direct_irradiance(const Tracer& tracer, const glm::dvec3& position) {
    IrradianceHarmonics irradiance;
    for (std::uint32_t i = 0; i < tracer.lights().size(); ++i) {
        if (model_of(tracer.lights()[i]).form == LightForm::kArea) {
            add_area_light(i, tracer, position, irradiance);
        } else if (const auto incident = incident_light(tracer, i, position)) {
            irradiance.add_direction(incident->direction, incident->irradiance);
        }
    }
    return irradiance;
}

IrradianceHarmonics trace_irradiance(const Tracer& tracer, const glm::dvec3& position,
                                     const LightProbeOptions& options) {
    RenderOptions render;
    render.samples_per_pixel = options.samples_per_pixel;
    render.max_bounces = options.max_bounces;
    render.show_environment = true;
    Image<RgbaF> map = tracer.render(all_directions(position, options.width), render).image;
    for (RgbaF& pixel : map.pixels()) pixel = {pixel.r * pixel.a, pixel.g * pixel.a, pixel.b * pixel.a, 1};
    IrradianceHarmonics irradiance = project_irradiance(map);
    return irradiance += direct_irradiance(tracer, position);
}

}  // namespace rs::capture
