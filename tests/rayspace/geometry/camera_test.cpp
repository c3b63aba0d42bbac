#include "rayspace/geometry/camera.hpp"
#include "rayspace/base/conventions.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace rs;

TEST(Camera, LookAtPutsTheTargetInTheMiddle) {
    const Camera camera = look_at_camera({1, 2, 3}, {-0.5, 0.25, 1}, radians(40), 64, 48);
    const glm::dvec3 p = camera.project({-0.5, 0.25, 1});
    EXPECT_NEAR(p.x, 32, 1e-9);
    EXPECT_NEAR(p.y, 24, 1e-9);
    EXPECT_NEAR(p.z, glm::length(glm::dvec3(1.5, 1.75, 2)), 1e-12);
    EXPECT_LT(rotation_error(camera), 1e-14);
}

TEST(Camera, FieldOfViewSpansTheWidth) {
    const Camera camera = look_at_camera({0, 0, 4}, {0, 0, 0}, radians(60), 200, 100);
    // At depth 4 half the width is 4 tan 30 degrees, to the right of a camera on +Z: along +X.
    const glm::dvec3 edge = camera.project({4 * std::tan(radians(30)), 0, 0});
    EXPECT_NEAR(edge.x, 200, 1e-9);
    EXPECT_NEAR(edge.y, 50, 1e-9);
    const glm::dvec3 above = camera.project({0, 1, 0});
    EXPECT_LT(above.y, 50) << "rows count downwards";
}

TEST(Camera, RayAndProjectAreInverse) {
    const unsigned seed = 20261;
    RecordProperty("seed", static_cast<int>(seed));
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int trial = 0; trial < 200; ++trial) {
        const glm::dvec3 eye(5 * unit(random), 5 * unit(random), 5 * unit(random));
        const glm::dvec3 target(unit(random), unit(random), unit(random));
        if (glm::length(target - eye) < 0.1) continue;
        Camera camera = look_at_camera(eye, target, radians(50), 640, 480);
        camera.fl_y = camera.fl_x * 1.1;
        camera.cx += 13.25;
        camera.cy -= 7.5;
        const double x = 320 + 400 * unit(random);
        const double y = 240 + 300 * unit(random);
        const double depth = 2.5 + 2 * unit(random);
        const glm::dvec3 back = camera.project(camera.centre() + depth * camera.ray(x, y));
        EXPECT_NEAR(back.x, x, 1e-8);
        EXPECT_NEAR(back.y, y, 1e-8);
        EXPECT_NEAR(back.z, depth, 1e-10);
    }
}

TEST(Camera, VerticalViewsHaveADefinedUp) {
    for (const double side : {-1.0, 1.0}) {
        const Camera camera = look_at_camera({0, side * 3, 0}, {0, 0, 0}, radians(40), 64, 48);
        EXPECT_LT(rotation_error(camera), 1e-14);
        EXPECT_NEAR(camera.up().z, 1, 1e-12);
    }
}

TEST(Camera, UprightMeansNeitherPitchNorRoll) {
    EXPECT_TRUE(is_upright(look_at_camera({2, 0.5, 2}, {0, 0.5, 0}, 1, 64, 48)));
    EXPECT_FALSE(is_upright(look_at_camera({2, 0.5, 2}, {0, 0.4999, 0}, 1, 64, 48)));
    Camera rolled = look_at_camera({0, 0, 2}, {0, 0, 0}, 1, 64, 48);
    rolled.world_from_camera[0] = glm::dvec4(std::cos(1e-6), std::sin(1e-6), 0, 0);
    rolled.world_from_camera[1] = glm::dvec4(-std::sin(1e-6), std::cos(1e-6), 0, 0);
    EXPECT_FALSE(is_upright(rolled));
}

TEST(Camera, RotationErrorSeesScaleMirrorAndNan) {
    Camera camera = look_at_camera({2, 1, 2}, {0, 0, 0}, 1, 64, 48);
    Camera scaled = camera;
    for (int i = 0; i < 3; ++i) scaled.world_from_camera[i] *= 1.01;
    EXPECT_NEAR(rotation_error(scaled), 0.0201, 1e-9);
    Camera mirrored = camera;
    mirrored.world_from_camera[0] = -mirrored.world_from_camera[0];
    EXPECT_GE(rotation_error(mirrored), 1);
    camera.world_from_camera[1][1] = std::nan("");
    EXPECT_FALSE(rotation_error(camera) < 1e9);
}

}  // namespace
