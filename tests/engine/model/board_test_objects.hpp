#pragma once
// Objects and views for the tests of the board: rings of noise pictures, and cameras that stand upright.

#include "engine/core/reconstruct.hpp"
#include "engine/model/board.hpp"
#include "engine/model/object_image.hpp"
#include "rayspace/conventions.hpp"
#include "rayspace/ray_space.hpp"
#include "tests/support/ring_object.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rs::engine::model::test {

// An upright camera at `azimuth`, `distance` and `height` (object radii), looking horizontally at the axis, whose
// picture shows `half_extent` radii to each side at the axis, along its larger side.
inline Camera upright_at(double azimuth, double distance, double height, double half_extent, int width,
                         int view_height) {
    const glm::dvec3 eye(distance * std::sin(azimuth), height, distance * std::cos(azimuth));
    const double fov_x = 2 * std::atan(half_extent / distance * width / std::max(width, view_height));
    Camera camera = upright_camera(look_at_camera(eye, {0, height, 0}, fov_x, width, view_height));
    camera.cy -= camera.fl_y * height / distance;
    return camera;
}

inline BoardConfig prototype() {
    Result<BoardConfig> config = read_board_config("prototype-2000");
    EXPECT_TRUE(config.ok());
    return *config;
}

inline Image<Rgba8> defined(const RaySpaceObject& object, const engine::ViewRegisters& registers) {
    Image<Rgba8> picture(registers.width, registers.height);
    reconstruct_scalar(object, registers, picture);
    return picture;
}

}  // namespace rs::engine::model::test
