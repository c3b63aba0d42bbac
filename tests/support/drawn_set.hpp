#pragma once
// A capture set on disk with computed images: coloured balls around the axis, seen by the set's cameras.

#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace rs::test {

/// Three balls, nearest first; edges smooth over about a pixel.
inline Image<Rgba8> draw_image(const Camera& camera) {
    struct Ball {
        glm::dvec3 centre;
        double radius;
        Rgba8 colour;
    };
    const Ball balls[] = {{{0.0, 0.0, 0.0}, 0.5, {200, 60, 40, 255}},
                          {{0.6, 0.2, 0.1}, 0.25, {40, 180, 70, 255}},
                          {{-0.3, -0.5, 0.5}, 0.2, {50, 80, 210, 255}}};
    Image<Rgba8> image(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            const glm::dvec3 ray = camera.ray(x + 0.5, y + 0.5);
            double nearest = 1e30;
            for (const Ball& ball : balls) {
                const glm::dvec3 to_ball = ball.centre - camera.centre();
                const double along = glm::dot(to_ball, ray) / glm::dot(ray, ray);
                if (along <= 0 || along > nearest) continue;
                const double miss = glm::length(to_ball - along * ray);
                const double pixel = along / camera.fl_x;
                const double cover = std::clamp((ball.radius - miss) / pixel + 0.5, 0.0, 1.0);
                if (cover <= 0) continue;
                const double shade = 0.5 + 0.5 * (1 - miss / (ball.radius + pixel));
                const auto shaded = [&](int c) { return static_cast<std::uint8_t>(std::lround(c * shade)); };
                image(x, y) = {shaded(ball.colour.r), shaded(ball.colour.g), shaded(ball.colour.b),
                               static_cast<std::uint8_t>(std::lround(255 * cover))};
                nearest = along;
            }
        }
    }
    return image;
}

/// A ring of small cameras around the balls.
inline Rig drawn_ring(int count, double elevation_deg = 0) {
    Rig rig = make_ring({.count = count,
                         .distance = 3.5,
                         .elevation_rad = radians(elevation_deg),
                         .fl_px = 130,
                         .width = 96,
                         .height = 80});
    rig.object_radius = 0.9;
    return rig;
}

/// Draws every view of `rig` into `folder`.
inline void write_drawn_set(const std::filesystem::path& folder, Rig rig,
                            Image<Rgba8> (*draw)(const Camera&) = draw_image) {
    std::filesystem::create_directories(folder);
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        rig.views[i].file_path = std::to_string(i) + ".png";
        const Status status = write_png(folder / rig.views[i].file_path, draw(rig.views[i].camera));
        ASSERT_TRUE(status.ok()) << status.error().message;
    }
    const Status status = write_rig(folder / kRigFileName, rig);
    ASSERT_TRUE(status.ok()) << status.error().message;
}

}  // namespace rs::test
