#include "capture/photos/segmentation/soft_shadow.hpp"

#include "capture/photos/segmentation/foreground_image.hpp"
#include "rayspace/image/linear_light.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::capture {
namespace {

constexpr int kShadow_side = 100;
constexpr float kFloor = 0.6F;  // linear light

struct ShadowScene {
    Image<Rgba8> photo{kShadow_side, kShadow_side};
    Image<LinearRgb> background{kShadow_side, kShadow_side, LinearRgb{kFloor, kFloor, kFloor}};
    Image<std::uint8_t> mask{kShadow_side, kShadow_side};
};

// A dark square on a floor; its shadow fades to the right, another dark patch stands apart.
float light_left(int x, int y) {
    if (x >= 5 && x < 12 && y >= 5 && y < 12) return 0.5F;
    if (y < 50 || y >= 70 || x < 60) return 1;
    return std::min(1.0F, 0.4F + 0.6F * static_cast<float>(x - 60) / 30);
}

ShadowScene shadow_scene() {
    ShadowScene scene;
    for (int y = 0; y < kShadow_side; ++y) {
        for (int x = 0; x < kShadow_side; ++x) {
            const bool is_object = x >= 30 && x < 60 && y >= 30 && y < 70;
            const std::uint8_t code = srgb8_from_linear(kFloor * light_left(x, y));
            scene.photo(x, y) = is_object ? Rgba8{20, 20, 20, 255} : Rgba8{code, code, code, 255};
            scene.mask(x, y) = is_object ? 255 : 0;
        }
    }
    return scene;
}

TEST(SoftShadow, IsTheShareOfLightThatIsMissing) {
    const ShadowScene s = shadow_scene();
    const Image<std::uint8_t> shadow = estimate_shadow(s.photo, s.background, s.mask);
    for (int x = 70; x < 85; x += 5) {
        EXPECT_NEAR(shadow(x, 60) / 255.0, 1 - static_cast<double>(light_left(x, 60)), 0.04) << x;
    }
    EXPECT_EQ(shadow(95, 20), 0) << "the lit floor";
    EXPECT_EQ(shadow(8, 8), 0) << "not connected to the object";
    EXPECT_GT(shadow(58, 60), 120) << "continued below the object's edge";
}

TEST(SoftShadow, CutoutOverTheFloorLooksLikeThePhoto) {
    const ShadowScene s = shadow_scene();
    Segmentation segmentation{s.mask, false};
    segmentation.shadow = estimate_shadow(s.photo, s.background, s.mask);
    const Image<Rgba8> foreground = make_foreground_image(s.photo, segmentation);
    for (int y = 35; y < 68; y += 3) {
        for (int x = 33; x < 95; x += 2) {
            if (std::abs(x - 60) < 4 || std::abs(y - 50) < 6) continue;
            const Rgba8& c = foreground(x, y);
            const float alpha = c.a / 255.0F;
            const float composed = alpha * linear_from_srgb8(c.g) + (1 - alpha) * kFloor;
            EXPECT_NEAR(srgb8_from_linear(composed), s.photo(x, y).g, 8) << x << "," << y;
        }
    }
    EXPECT_EQ(foreground(75, 60).g, 0) << "black";
}

}  // namespace
}  // namespace rs::capture
