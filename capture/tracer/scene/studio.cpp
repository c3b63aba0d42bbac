#include "capture/tracer/scene/studio.hpp"

#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>

namespace rs::capture {

namespace {

constexpr int kHeight_px = 256;  // 0.7 degrees a pixel

float smooth_step(float t) {
    const float c = std::clamp(t, 0.0F, 1.0F);
    return c * c * (3.0F - 2.0F * c);
}

// Share of the softbox's radiance in a direction, 0..1. The box is a rectangle in azimuth and elevation of a sphere
// whose equator passes through its centre, so that boxes near the zenith keep their shape.
float softbox_coverage(const Softbox& box, const glm::dvec3& direction) {
    const double azimuth = radians(static_cast<double>(box.azimuth_deg));
    const double elevation = radians(static_cast<double>(box.elevation_deg));
    const glm::dvec3 outward(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                             std::cos(azimuth) * std::cos(elevation));
    const glm::dvec3 right(std::cos(azimuth), 0, -std::sin(azimuth));
    const glm::dvec3 up = glm::cross(outward, right);
    const double x_deg = degrees(std::atan2(glm::dot(direction, right), glm::dot(direction, outward)));
    const double y_deg = degrees(std::asin(std::clamp(glm::dot(direction, up), -1.0, 1.0)));
    const float edge = std::max(box.edge_deg, 0.01F);
    const float inside_x = 0.5F * box.width_deg - static_cast<float>(std::abs(x_deg));
    const float inside_y = 0.5F * box.height_deg - static_cast<float>(std::abs(y_deg));
    return smooth_step(inside_x / edge) * smooth_step(inside_y / edge);
}

}  // namespace

Studio default_studio() {
    Studio studio;
    studio.softboxes = {
        {-45.0F, 45.0F, 70.0F, 50.0F, 8.0F, {3.0F, 2.95F, 2.85F}},
        {65.0F, 20.0F, 50.0F, 70.0F, 8.0F, {1.1F, 1.13F, 1.18F}},
        {170.0F, 35.0F, 110.0F, 25.0F, 6.0F, {1.6F, 1.6F, 1.6F}},
    };
    return studio;
}

Environment make_studio_environment(const Studio& studio) {
    Environment environment;
    environment.pixels = Image<RgbaF>(2 * kHeight_px, kHeight_px);
    for (int y = 0; y < kHeight_px; ++y) {
        const double polar = kPi * (y + 0.5) / kHeight_px;
        const double height = std::cos(polar);
        // Floor and ceiling blend over 20 degrees like a seamless paper backdrop.
        const float above = smooth_step(static_cast<float>(height) * 2.9F + 0.5F);
        const glm::vec3 ceiling = glm::mix(studio.horizon, studio.zenith, std::max(0.0F, static_cast<float>(height)));
        const glm::vec3 gradient = glm::mix(studio.floor, ceiling, above);
        for (int x = 0; x < 2 * kHeight_px; ++x) {
            const double phi = kPi * ((x + 0.5) / kHeight_px - 1.0);
            const glm::dvec3 direction(std::sin(polar) * std::sin(phi), height, -std::sin(polar) * std::cos(phi));
            glm::vec3 radiance = gradient;
            for (const Softbox& box : studio.softboxes) {
                radiance = glm::mix(radiance, box.radiance, softbox_coverage(box, direction));
            }
            environment.pixels(x, y) = {radiance.r, radiance.g, radiance.b, 1.0F};
        }
    }
    return environment;
}

}  // namespace rs::capture
