#pragma once
// Balls about the origin: one whose colour depends only on height, and one without stripes.

#include "encode/raymap/silhouettes/work_view.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <cmath>
#include <cstdint>

namespace rs::encode {

inline constexpr double kBallRadius = 0.8;

/// Draws a ball: opaque, coloured by the hit point; transparent beside it.
template <class Colour>
Image<Rgba8> drawn_ball(const Camera& camera, const Colour& colour) {
    Image<Rgba8> image(camera.width, camera.height);
    const glm::dvec3 eye = camera.centre();
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const glm::dvec3 ray = glm::normalize(camera.ray(x + 0.5, y + 0.5));
            const double along = -glm::dot(ray, eye);
            const double inside = kBallRadius * kBallRadius + along * along - glm::dot(eye, eye);
            if (inside < 0) continue;
            const glm::dvec3 found = colour(eye + (along - std::sqrt(inside)) * ray);
            const auto code = [](double wave) { return static_cast<std::uint8_t>(128 + std::lround(100 * wave)); };
            image(x, y) = {code(found.r), code(found.g), code(found.b), 255};
        }
    }
    return image;
}

inline Image<Rgba8> striped_ball(const Camera& camera) {
    return drawn_ball(
        camera, [](const glm::dvec3& place) { return glm::dvec3(std::sin(35 * place.y), std::cos(35 * place.y), 0); });
}

/// A ball with a different colour everywhere.
inline Image<Rgba8> mottled_ball(const Camera& camera) {
    return drawn_ball(camera, [](const glm::dvec3& place) {
        return glm::dvec3(std::sin(21 * place.x + 5 * place.y), std::sin(19 * place.y - 4 * place.z),
                          std::sin(23 * place.z + 3 * place.x));
    });
}

/// Depth of the ball at a pixel, as in DepthView::depth; NaN if the ray misses it.
inline double ball_depth(const WorkView& view, int column, int row) {
    const HorizontalRay ray = view.ray_of(column + 0.5);
    const double rise = (view.height_of(row + 0.5, 1) - view.centre_y) / ray.horizontal_per_axial;
    const double foot_y = view.centre_y + ray.to_foot * rise;
    const double a = 1 + rise * rise;
    const double half_b = rise * foot_y;
    const double c = foot_y * foot_y + glm::dot(ray.foot, ray.foot) - kBallRadius * kBallRadius;
    return (-half_b - std::sqrt(half_b * half_b - a * c)) / a;
}

}  // namespace rs::encode
