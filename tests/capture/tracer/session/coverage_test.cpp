#include "capture/tracer/session/coverage.hpp"

#include <gtest/gtest.h>

namespace rs::capture {
namespace {

TEST(Recentring, TheObjectFillsTheFrameAndStandsInItsMiddle) {
    Image<float> coverage(200, 100, 0.0F);
    for (int y = 20; y < 60; ++y) {
        for (int x = 30; x < 80; ++x) coverage(x, y) = 0.5F;
    }
    const ImagePlacement place = recentring_placement(coverage);
    const glm::dvec2 middle(100, 50);
    EXPECT_DOUBLE_EQ(place.scale, kRecentredFill * 100 / 40);  // its height reaches the frame first
    EXPECT_LT(glm::distance(place.seen({55, 40}, middle), middle), 1e-9);
    EXPECT_EQ(recentring_placement(Image<float>(8, 8, 0.0F)).scale, 1);
}

TEST(Recentring, RaysAndBackdropMoveAlike) {
    const ImagePlacement place{{12, -3}, 1.5};
    RayImage rays;
    rays.width = 64;
    rays.height = 48;
    rays.ray = [](double x, double y) { return glm::dvec3(x, y, 1); };
    const RayImage moved = apply_placement(rays, place);
    Image<RgbaF> ramp(64, 48);
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) ramp(x, y) = {static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F, 0, 1};
    }
    const Image<RgbaF> image = apply_placement(ramp, place);
    for (const glm::ivec2 p : {glm::ivec2(20, 10), glm::ivec2(33, 25), glm::ivec2(60, 40)}) {
        const glm::dvec3 ray = moved.ray(p.x + 0.5, p.y + 0.5);
        EXPECT_LT(glm::distance(place.seen({ray.x, ray.y}, {32, 24}), glm::dvec2(p.x + 0.5, p.y + 0.5)), 1e-9);
        EXPECT_NEAR(static_cast<double>(image(p.x, p.y).r), ray.x, 1e-3);
        EXPECT_NEAR(static_cast<double>(image(p.x, p.y).g), ray.y, 1e-3);
    }
    EXPECT_NEAR(apply_placement(ramp, {{-200, 0}, 1})(0, 0).r, 63.5F, 1e-3F) << "beyond the border it is continued";
}

}  // namespace
}  // namespace rs::capture
