#pragma once
// A ball about the origin whose colour depends on height alone.

#include "encode/raymap/work_view.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

#include <cmath>
#include <cstdint>

namespace rs::encode {

inline constexpr double kBallRadius = 0.8;

inline Image<Rgba8> striped_ball(const Camera& camera) {
    Image<Rgba8> picture(camera.width, camera.height);
    const glm::dvec3 eye = camera.centre();
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
            const glm::dvec3 ray = glm::normalize(camera.ray(x + 0.5, y + 0.5));
            const double along = -glm::dot(ray, eye);
            const double inside = kBallRadius * kBallRadius + along * along - glm::dot(eye, eye);
            if (inside < 0) continue;
            const double height = eye.y + (along - std::sqrt(inside)) * ray.y;
            const auto code = [](double wave) { return static_cast<std::uint8_t>(128 + std::lround(100 * wave)); };
            picture(x, y) = {code(std::sin(35 * height)), code(std::cos(35 * height)), 128, 255};
        }
    }
    return picture;
}

// Where the ray of a pixel meets it, as DepthView::depth has it; NaN where it does not.
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
