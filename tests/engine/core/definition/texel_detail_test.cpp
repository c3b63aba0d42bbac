// Tests of the filters of section 7 of engine/RECONSTRUCTION.md.
#include "engine/core/definition/texel_detail.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::engine {
namespace {

PlanarImage opaque_image(int width, int height) {
    PlanarImage image;
    image.y = Image<std::uint8_t>(width, height, 100);
    image.a = Image<std::uint8_t>(width, height, 255);
    return image;
}

TEST(TexelDetail, IsFiveSixteenthsOfTheNegatedLaplacianRoundedAndClamped) {
    EXPECT_EQ(texel_detail(100, 100, 100, 100, 100), 0);
    EXPECT_EQ(texel_detail(108, 100, 100, 100, 100), 10);
    EXPECT_EQ(texel_detail(100, 101, 100, 100, 100), 0);  // -5/16
    EXPECT_EQ(texel_detail(100, 102, 100, 100, 100), -1);
    EXPECT_EQ(texel_detail(255, 0, 0, 0, 0), 127);
    EXPECT_EQ(texel_detail(0, 255, 255, 255, 255), -128);
}

TEST(TexelDetail, IsZeroOnTheBorderAndBesideTransparency) {
    PlanarImage image = opaque_image(5, 4);
    image.y(2, 2) = 140;
    EXPECT_EQ(texel_detail_at(image, 2, 2), 50);
    EXPECT_EQ(texel_detail_at(image, 1, 2), -12);
    EXPECT_EQ(texel_detail_at(image, 2, 3), 0);
    EXPECT_EQ(texel_detail_at(image, 0, 2), 0);
    for (const auto& [column, row] : {std::pair{2, 2}, {1, 2}, {3, 2}, {2, 1}, {2, 3}}) {
        PlanarImage soft = image;
        soft.a(column, row) = 254;
        EXPECT_EQ(texel_detail_at(soft, 2, 2), 0) << column << " " << row;
    }
    image.a(1, 1) = 0;  // a diagonal neighbor
    EXPECT_EQ(texel_detail_at(image, 2, 2), 50);
}

// Cubic interpolation is exact for luma that is quadratic in x. Along one axis the sharp filter adds 5/8 of its
// difference to bilinear interpolation: 5/4 of the mean of both axes' parts, of which one is 0.
TEST(SampleDetail, AddsFiveEighthsOfTheDifferenceToCubicInterpolation) {
    constexpr double kCurvature = 16;  // luma = kCurvature / 2 * x * x
    constexpr int kDetail = -5;        // 5/16 of it, negated
    constexpr int kOpaque = 64 * 255;
    for (int fx = 0; fx < 8; ++fx) {
        const double x = fx / 8.0;
        const double missing = kCurvature / 2 * (x * x - x);  // exact - bilinear between 0 and 1
        const double added = sample_detail(TexelFilter::kSharp, fx, 0, kOpaque, 64 * kDetail) / double{kOpaque};
        EXPECT_NEAR(added, 0.625 * missing, 1.0 / 64) << fx;
    }
}

TEST(SampleDetail, SmoothIsALowPassFilterAtEveryPosition) {
    // Weights 1/2 and 1/8: half of a single bright pixel remains.
    const int detail = texel_detail(140, 100, 100, 100, 100);
    for (int f = 0; f < 8; ++f) {
        const double added = sample_detail(TexelFilter::kSmooth, f, 7 - f, 64 * 255, 64 * detail) / (64.0 * 255);
        EXPECT_NEAR(added, -20, 0.5);
    }
}

TEST(SampleDetail, AddsNothingOnTexelsAndToBilinearSamples) {
    EXPECT_EQ(sample_detail(TexelFilter::kSharp, 0, 0, 64 * 255, 64 * 127), 0);
    EXPECT_EQ(sample_detail(TexelFilter::kBilinear, 3, 5, 64 * 255, 64 * 127), 0);
    EXPECT_EQ(sample_detail(TexelFilter::kSharp, 4, 4, 0, 64 * 127), 0);
}

}  // namespace
}  // namespace rs::engine
