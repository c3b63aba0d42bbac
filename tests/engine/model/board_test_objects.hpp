#pragma once
// Objects and views for board tests: rings of noise images, and upright cameras.

#include "engine/core/definition/reconstruct.hpp"
#include "engine/model/board.hpp"
#include "engine/model/layout/object_image.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/ray_space.hpp"
#include "tests/support/ring_object.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace rs::engine::model::test {

// Upright camera at `azimuth`, `distance` and `height` (object radii), looking horizontally at the axis; its image
// covers `half_extent` radii to each side at the axis, along its larger side.
inline Camera upright_at(double azimuth, double distance, double height, double half_extent, int width,
                         int view_height) {
    const glm::dvec3 eye(distance * std::sin(azimuth), height, distance * std::cos(azimuth));
    const double fov_x = 2 * std::atan(half_extent / distance * width / std::max(width, view_height));
    Camera camera = upright_camera(look_at_camera(eye, {0, height, 0}, fov_x, width, view_height));
    camera.cy -= camera.fl_y * height / distance;
    return camera;
}

// Uniform random number in [low, high).
inline double in(std::mt19937_64& random, double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(random() >> 11), -53);
}

// Random upright camera around an object; image sides below `most_px`.
inline Camera random_upright(std::mt19937_64& random, int most_px) {
    const double azimuth = in(random, 0, 2 * kPi);
    const double distance = in(random, 1.2, 12);
    const double height = in(random, -1, 1);
    const double half_extent = in(random, 0.3, 1.6);
    const int width = static_cast<int>(in(random, 1, most_px));
    const int view_height = static_cast<int>(in(random, 1, most_px));
    return upright_at(azimuth, distance, height, half_extent, width, view_height);
}

inline BoardConfig prototype() {
    Result<BoardConfig> config = read_board_config("prototype-2000");
    EXPECT_TRUE(config.ok());
    return *config;
}

inline Image<Rgba8> defined(const RaySpaceObject& object, const engine::ViewRegisters& registers) {
    Image<Rgba8> image(registers.width, registers.height);
    reconstruct_scalar(object, registers, image);
    return image;
}

struct Scene {
    RaySpaceObject object;
    std::vector<std::vector<engine::ViewRegisters>> cycles;
};

// Views of `side` pixels that are filled by an object whose images have the same size.
inline Scene filled(int side, int views, int cycles) {
    Scene scene{rs::test::ring_object({.views = 36,
                                       .width = side,
                                       .height = side,
                                       .fl_px = side * 1.5,
                                       .planes = 12,
                                       .x_cells = 64,
                                       .u_cells = 64}),
                {}};
    for (int c = 0; c < cycles; ++c) {
        scene.cycles.emplace_back();
        for (int v = 0; v < views; ++v) {
            const auto prepared = prepare_view(scene.object, upright_at(0.1 * v + 0.03 * c, 3.5, 0, 0.95, side, side));
            EXPECT_TRUE(prepared.ok());
            scene.cycles.back().push_back(*prepared);
        }
    }
    return scene;
}

}  // namespace rs::engine::model::test
