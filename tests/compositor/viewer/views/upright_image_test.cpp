#include "compositor/viewer/views/upright_image.hpp"

#include "rayspace/base/conventions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rs::compositor {
namespace {

const BoundingCylinder kBound{0.8, -0.9, 0.7};

Camera rolled(Camera camera, double angle_rad) {
    const glm::dvec4 right = camera.world_from_camera[0];
    const glm::dvec4 up = camera.world_from_camera[1];
    camera.world_from_camera[0] = right * std::cos(angle_rad) + up * std::sin(angle_rad);
    camera.world_from_camera[1] = up * std::cos(angle_rad) - right * std::sin(angle_rad);
    return camera;
}

TEST(UprightImage, ShowsEveryPointOfTheObjectWhereTheHomographySays) {
    constexpr std::uint64_t kSeed = 5;
    SCOPED_TRACE(kSeed);
    std::mt19937_64 random(kSeed);
    std::uniform_real_distribution<double> number(-1, 1);
    int images = 0;
    int points = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const glm::dvec3 eye(number(random) * 5, number(random) * 3, number(random) * 5);
        if (std::hypot(eye.x, eye.z) < 1.2) continue;
        const glm::dvec3 at(number(random), number(random), number(random));
        Camera camera = rolled(look_at_camera(eye, at, radians(60), 160, 120), number(random));
        if (trial % 2 == 0) camera.world_from_camera[0] = -camera.world_from_camera[0];  // left-handed
        const auto area = covering_rectangle(kBound, camera);
        if (!area) continue;
        const auto upright = upright_image(camera, *area, kBound, 1.5);
        if (!upright) continue;
        ++images;
        EXPECT_TRUE(is_upright(upright->camera));
        EXPECT_LT(rotation_error(upright->camera), 1e-9);
        for (int n = 0; n < 50; ++n) {
            const double angle = number(random) * 3.2;
            const glm::dvec3 p(kBound.radius * std::sin(angle), -0.1 + 0.8 * number(random),
                               kBound.radius * std::cos(angle));
            const glm::dvec3 seen = camera.project(p);
            if (seen.z < 0.01 || seen.x < area->x || seen.y < area->y || seen.x > area->x + area->width ||
                seen.y > area->y + area->height) {
                continue;
            }
            ++points;
            const glm::dvec3 direct = upright->camera.project(p);
            const glm::dvec3 mapped = upright->image_from_screen * glm::dvec3(seen.x, seen.y, 1);
            EXPECT_NEAR(mapped.x / mapped.z, direct.x, 1e-6);
            EXPECT_NEAR(mapped.y / mapped.z, direct.y, 1e-6);
            EXPECT_NEAR(mapped.z * seen.z, direct.z, 1e-9);
            // Inside of the image, except for rounding to whole pixels at its edge.
            EXPECT_GE(direct.x, -1e-6);
            EXPECT_GE(direct.y, -1e-6);
            EXPECT_LE(direct.x, upright->camera.width + 1e-6);
            EXPECT_LE(direct.y, upright->camera.height + 1e-6);
        }
    }
    EXPECT_GT(images, 150);
    EXPECT_GT(points, 2000);
}

TEST(UprightImage, HasAtLeastTheSamplesThatWereAskedFor) {
    for (const double pitch : {0.0, 15.0, 35.0, 50.0}) {
        const glm::dvec3 eye(0, 4 * std::sin(radians(pitch)), 4 * std::cos(radians(pitch)));
        const Camera camera = look_at_camera(eye, {0, 0, 0}, radians(50), 200, 200);
        const auto area = covering_rectangle(kBound, camera);
        ASSERT_TRUE(area);
        const auto upright = upright_image(camera, *area, kBound, 2);
        ASSERT_TRUE(upright) << pitch;
        const auto place = [&](double x, double y) {
            const glm::dvec3 p = upright->image_from_screen * glm::dvec3(x, y, 1);
            return glm::dvec2(p) / p.z;
        };
        const double x = area->x + area->width / 2.0;
        const double y = area->y + area->height / 2.0;
        EXPECT_GE(glm::distance(place(x + 0.5, y), place(x - 0.5, y)), 2 - 1e-3) << pitch;
        EXPECT_GE(glm::distance(place(x, y + 0.5), place(x, y - 0.5)), 2 - 1e-3) << pitch;
        if (pitch == 0.0) {  // only a larger image
            EXPECT_NEAR(upright->camera.width, 2 * area->width, 2);
            EXPECT_NEAR(upright->camera.height, 2 * area->height, 2);
        }
    }
}

TEST(UprightImage, SteepViewsHaveNone) {
    const auto of_pitch = [](double pitch) {
        const glm::dvec3 eye(0, 4 * std::sin(radians(pitch)), 4 * std::cos(radians(pitch)));
        const Camera camera = look_at_camera(eye, {0, 0, 0}, radians(50), 200, 200);
        return upright_image(camera, covering_rectangle(kBound, camera).value(), kBound, 1);
    };
    EXPECT_TRUE(of_pitch(45));
    EXPECT_TRUE(of_pitch(-45));
    EXPECT_FALSE(of_pitch(75));
    EXPECT_FALSE(of_pitch(-88));
}

}  // namespace
}  // namespace rs::compositor
