// Resampling of upright images for tilted cameras (compositor/web/view/row_sampling.hpp).

#include "compositor/web/view/row_sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::web {
namespace {

// Red and green are the position of the pixel, in steps of 2.
Image<Rgba8> positions(int width, int height) {
    Image<Rgba8> image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image(x, y) = {static_cast<std::uint8_t>(2 * x), static_cast<std::uint8_t>(2 * y), 0, 255};
        }
    }
    return image;
}

TEST(RowSampling, IdentityKeepsThePixels) {
    Image<Rgba8> image = positions(30, 20);
    image(4, 5).a = 90;
    image(6, 5) = {};
    const auto rows = sampled_rows(glm::dmat3(1), 30, 20);
    ASSERT_TRUE(rows);
    Image<Rgba8> resampled(30, 20);
    resample(image, *rows, resampled);
    EXPECT_EQ(resampled, image);
}

// A homography of a camera without roll: columns converge from row to row.
TEST(RowSampling, FollowsAHomography) {
    const Image<Rgba8> image = positions(100, 90);
    constexpr int kWidth = 80;
    constexpr int kHeight = 70;
    const glm::dmat3 homography(glm::dvec3(1.1, 0, 0), glm::dvec3(0.12, 1.2, 0.003), glm::dvec3(3.3, -5.6, 1));
    const auto rows = sampled_rows(homography, kWidth, kHeight);
    ASSERT_TRUE(rows);
    Image<Rgba8> resampled(kWidth, kHeight);
    resample(image, *rows, resampled);
    int opaque = 0;
    for (int j = 0; j < kHeight; ++j) {
        for (int i = 0; i < kWidth; ++i) {
            const glm::dvec3 at = homography * glm::dvec3(i + 0.5, j + 0.5, 1);
            const glm::dvec2 expected(at.x / at.z - 0.5, at.y / at.z - 0.5);
            const bool is_inside = expected.x >= 0 && expected.y >= 0 && expected.x <= 99 && expected.y <= 89;
            const Rgba8 p = resampled(i, j);
            if (!is_inside) {
                EXPECT_LT(p.a, 255);
                continue;
            }
            ++opaque;
            EXPECT_EQ(p.a, 255);
            EXPECT_NEAR(p.r, 2 * expected.x, 0.6) << i << ", " << j;
            EXPECT_NEAR(p.g, 2 * expected.y, 0.6) << i << ", " << j;
        }
    }
    EXPECT_GT(opaque, 3000);
}

TEST(RowSampling, RowsBehindTheCameraAreTransparent) {
    const auto rows =
        sampled_rows(glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, -0.1), glm::dvec3(0, 0, 1)), 20, 20);
    ASSERT_TRUE(rows);
    Image<Rgba8> resampled(20, 20, Rgba8{1, 2, 3, 4});
    resample(positions(20, 20), *rows, resampled);
    EXPECT_GT(resampled(1, 0).a, 0);
    EXPECT_EQ(resampled(1, 10), Rgba8{});
    EXPECT_EQ(resampled(1, 19), Rgba8{});
}

TEST(RowSampling, RefusesRollAndCoordinatesBeyond32Bits) {
    const double roll = 0.1;
    const glm::dmat3 turned(glm::dvec3(std::cos(roll), std::sin(roll), 0),
                            glm::dvec3(-std::sin(roll), std::cos(roll), 0), glm::dvec3(0, 0, 1));
    EXPECT_FALSE(sampled_rows(turned, 20, 20));
    EXPECT_FALSE(sampled_rows(glm::dmat3(glm::dvec3(10, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)), 8000, 20));
}

}  // namespace
}  // namespace rs::web
