#include "capture/photos/intake/reduction.hpp"

#include "rayspace/image/linear_light.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rs::capture {
namespace {

TEST(Reduced, CopiesSmallImages) {
    Image<Rgba8> image(7, 5, Rgba8{1, 2, 3, 0});
    image(3, 2) = {9, 8, 7, 6};
    EXPECT_EQ(reduced(image, 7), image);
}

TEST(Reduced, AveragesByCoveredArea) {
    // 3 pixels over 2: the middle one is shared. Weights 2/3 and 1/3.
    Image<Rgba8> row(3, 1, Rgba8{0, 0, 0, 255});
    row(0, 0).r = 90;
    row(1, 0).g = 90;
    row(2, 0).b = 90;
    const Image<Rgba8> two = reduced(row, 2);
    ASSERT_EQ(two.width(), 2);
    ASSERT_EQ(two.height(), 1);
    EXPECT_EQ(two(0, 0), (Rgba8{60, 30, 0, 255}));
    EXPECT_EQ(two(1, 0), (Rgba8{0, 30, 60, 255}));

    Image<Rgba8> column(1, 3, Rgba8{0, 0, 0, 255});
    for (int y = 0; y < 3; ++y) column(0, y) = row(y, 0);
    const Image<Rgba8> upright = reduced(column, 2);
    ASSERT_EQ(upright.height(), 2);
    EXPECT_EQ(upright(0, 0), two(0, 0));
    EXPECT_EQ(upright(0, 1), two(1, 0));
}

TEST(Reduced, WeighsColoursByAlpha) {
    Image<Rgba8> image(4, 4, Rgba8{255, 255, 255, 0});
    for (int y = 0; y < 4; ++y) image(0, y) = {200, 100, 50, 255};
    const Image<Rgba8> small = reduced(image, 2);
    EXPECT_EQ(small(0, 0), (Rgba8{200, 100, 50, 128}));
    EXPECT_EQ(small(1, 1), (Rgba8{0, 0, 0, 0}));
}

TEST(Reduced, KeepsUniformImagesUniform) {
    const Rgba8 uniform{17, 130, 254, 255};
    for (const int side : {1, 2, 37, 99, 160}) {
        const Image<Rgba8> small = reduced(Image<Rgba8>(161, 103, uniform), side);
        EXPECT_EQ(small.width(), side);
        for (const Rgba8& p : small.pixels()) ASSERT_EQ(p, uniform) << side;
    }
}

TEST(ReducedInLinearLight, AveragesLightRatherThanCodes) {
    Image<Rgba8> squares(8, 6, Rgba8{0, 0, 0, 255});
    for (int y = 0; y < 6; ++y) {
        for (int x = y % 2; x < 8; x += 2) squares(x, y) = {255, 255, 255, 255};
    }
    const Rgba8 half = {188, 188, 188, 255};  // half the light of 255
    ASSERT_EQ(srgb8_from_linear(0.5F), half.r);
    const Image<Rgba8> grey = reduced_in_linear_light(squares, 4, 3, 2);
    for (const Rgba8& p : grey.pixels()) EXPECT_EQ(p, half);
    EXPECT_EQ(reduced(squares, 4)(0, 0).r, 128);
}

TEST(ReducedInLinearLight, IsCentred) {
    // The inner five of seven pixels, two and a half for each result pixel.
    Image<Rgba8> rows(7, 3, Rgba8{0, 0, 0, 255});
    for (int y = 0; y < 3; ++y) {
        rows(0, y).r = rows(6, y).r = 255;
        rows(1, y).g = 255;
        rows(3, y).b = 255;
    }
    const Image<Rgba8> two = reduced_in_linear_light(rows, 2, 1, 2.5);
    EXPECT_EQ(two(0, 0).r, 0);
    EXPECT_EQ(two(1, 0).r, 0);
    EXPECT_EQ(two(0, 0).g, srgb8_from_linear(1 / 2.5F));
    EXPECT_EQ(two(0, 0).b, srgb8_from_linear(0.5F / 2.5F));
    EXPECT_EQ(two(1, 0).b, srgb8_from_linear(0.5F / 2.5F));
}

TEST(ReducedInLinearLight, WeighsColoursByAlpha) {
    Image<Rgba8> image(4, 4, Rgba8{255, 255, 255, 0});
    for (int y = 0; y < 4; ++y) image(0, y) = {200, 100, 50, 255};
    const Image<Rgba8> small = reduced_in_linear_light(image, 2, 2, 2);
    EXPECT_EQ(small(0, 0), (Rgba8{200, 100, 50, 128}));
    EXPECT_EQ(small(1, 1).a, 0);
}

TEST(ReducedInLinearLight, KeepsUniformImagesUniform) {
    const Rgba8 uniform{17, 130, 254, 255};
    for (const double step : {1.0, 1.3, 2.0, 2.93, 16.1}) {
        const int width = static_cast<int>(161 / step), height = static_cast<int>(103 / step);
        const Image<Rgba8> small = reduced_in_linear_light(Image<Rgba8>(161, 103, uniform), width, height, step);
        EXPECT_EQ(small.width(), width);
        for (const Rgba8& p : small.pixels()) ASSERT_EQ(p, uniform) << step;
    }
}

// The centroid of a disc is preserved within a hundredth of a pixel.
TEST(ReducedInLinearLight, PreservesPositions) {
    const double cx = 61.37, cy = 40.81, step = 2.6;
    Image<Rgba8> image(131, 97, Rgba8{0, 0, 0, 255});
    for (int y = 0; y < 97; ++y) {
        for (int x = 0; x < 131; ++x) {
            const double inside = 20.5 - std::hypot(x + 0.5 - cx, y + 0.5 - cy);
            const std::uint8_t code = srgb8_from_linear(static_cast<float>(std::clamp(inside, 0.0, 1.0)));
            image(x, y) = {code, code, code, 255};
        }
    }
    const int width = static_cast<int>(131 / step), height = static_cast<int>(97 / step);
    const Image<Rgba8> small = reduced_in_linear_light(image, width, height, step);
    double sum = 0, sum_x = 0, sum_y = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double light = linear_from_srgb8(small(x, y).r);
            sum += light;
            sum_x += light * (x + 0.5);
            sum_y += light * (y + 0.5);
        }
    }
    EXPECT_NEAR(sum_x / sum, 0.5 * width + (cx - 0.5 * 131) / step, 0.01);
    EXPECT_NEAR(sum_y / sum, 0.5 * height + (cy - 0.5 * 97) / step, 0.01);
}

}  // namespace
}  // namespace rs::capture
