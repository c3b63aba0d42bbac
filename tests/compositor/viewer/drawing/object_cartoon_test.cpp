#include "compositor/viewer/drawing/object_cartoon.hpp"

#include "rayspace/image/linear_light.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

namespace rs::compositor {
namespace {

const ObjectCartoon kTwoTones{{0.5F}, {0.8F, 0.3F}};

// A grey ramp with noise in the middle of a transparent image.
Image<Rgba8> ramp() {
    Image<Rgba8> image(64, 32);
    for (int y = 4; y < 28; ++y) {
        for (int x = 4; x < 60; ++x) {
            const auto code = static_cast<std::uint8_t>(4 * x + (x * 7 + y * 13) % 5);
            image(x, y) = {code, code, code, 255};
        }
    }
    return image;
}

TEST(ObjectCartoons, HaveTheTonesOfTheStyle) {
    const Image<Rgba8> cartoon = cartoon_of(ramp(), kTwoTones, 1, 0);
    std::set<int> row;
    for (int x = 6; x < 58; ++x) row.insert(cartoon(x, 16).g);
    EXPECT_TRUE(row.contains(198) && row.contains(71));  // L* of 80 and 30
    EXPECT_LE(row.size(), 6U);                           // and the ramp between them
    EXPECT_EQ(cartoon(0, 0).a, 0);
    EXPECT_EQ(cartoon(10, 16).a, 255);
}

TEST(ObjectCartoons, KeepHue) {
    const Image<Rgba8> red(16, 16, {150, 40, 30, 255});
    const Rgba8 drawn = cartoon_of(red, kTwoTones, 1, 0)(8, 8);
    const auto hue = [](Rgba8 p) {  // of the hexcone model, in linear light
        return (linear_from_srgb8(p.g) - linear_from_srgb8(p.b)) / (linear_from_srgb8(p.r) - linear_from_srgb8(p.b));
    };
    EXPECT_NEAR(hue(drawn), hue(red(8, 8)), 0.01F);
    EXPECT_GT(drawn.r, 2 * drawn.g);
}

TEST(ObjectCartoons, LinesFollowTheSilhouetteWithTheGivenWidth) {
    ObjectCartoon style = kTwoTones;
    style.line_colour = {1, 0, 0};
    const Image<Rgba8> cartoon = cartoon_of(ramp(), style, 1, 3);
    const auto is_line = [&](int x, int y) { return cartoon(x, y).r == 255 && cartoon(x, y).g == 0; };
    for (const int x : {4, 5, 6, 57, 58, 59}) EXPECT_TRUE(is_line(x, 16)) << x;
    for (const int x : {8, 30, 55}) EXPECT_FALSE(is_line(x, 16)) << x;
    EXPECT_TRUE(is_line(30, 4));
    EXPECT_EQ(cartoon(3, 16).a, 0);
}

}  // namespace
}  // namespace rs::compositor
