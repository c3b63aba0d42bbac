#include "capture/tracer/integrator/light_probe.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

// Scoped lights reach positions within the bounds of their scope.
void add_light(std::uint32_t index, const Tracer& tracer, const glm::dvec3& position, Image<RgbaF>& map) {
    const Light& light = tracer.lights()[index];
    const ShadowCasters casters{light.casts_shadows, light.everywhere ? kUnscoped : index};
    if (!light.everywhere && !tracer.scope_bounds(index).contains(glm::vec3(position))) return;
    const glm::vec3 irradiance = irradiance_at(light, position);
    if (irradiance == glm::vec3(0)) return;
    const bool distant = model_of(light).form == LightForm::kDistant;
    const glm::dvec3 way = distant ? -light.towards : light.location - position;
    const double distance = glm::length(way);
    const glm::dvec3 direction = way / distance;
    const double reach = distant ? std::numeric_limits<double>::infinity() : distance;
    if (!tracer.is_unoccluded(position, direction, reach, casters)) return;
    const int width = map.width();
    const double turns = 0.5 + std::atan2(direction.x, -direction.z) / (2 * kPi);
    const double polar = std::acos(std::clamp(direction.y, -1.0, 1.0)) / kPi;
    const int x = std::clamp(static_cast<int>(turns * width), 0, width - 1);
    const int y = std::clamp(static_cast<int>(polar * map.height()), 0, map.height() - 1);
    const glm::vec3 radiance = irradiance / static_cast<float>(solid_angle(y, width));
    RgbaF& pixel = map(x, y);
    pixel = {pixel.r * pixel.a + radiance.r, pixel.g * pixel.a + radiance.g, pixel.b * pixel.a + radiance.b, 1};
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

}  // namespace rs::capture
