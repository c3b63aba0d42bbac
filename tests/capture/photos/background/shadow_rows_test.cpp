// Rows without a shadow of the object.

#include "capture/photos/background/background_gradient.hpp"

#include "capture/photos/background/exposure_normalized_frames.hpp"
#include "rayspace/image/linear_light.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kRows_width = 160, kRows_height = 120, kRows_frames = 12;
constexpr std::uint8_t kGrey = 190;

// A dark box on row 80 and moves to the right from frame to frame.
bool in_box(int frame, int x, int y) {
    return std::abs(x - 60 - 3 * frame) < 16 && y >= 30 && y < 80;
}

// Factor of light in a soft shadow with its centre at (0, 0).
double soft_shadow(double x, double y) {
    return 1 - 0.5 * std::exp(-std::pow(x / 30, 2) - std::pow(y / 12, 2));
}

enum class Shadow { kNone, kSoft, kHard };

Image<Rgba8> frame_of(int frame, Shadow shadow) {
    Image<Rgba8> image(kRows_width, kRows_height, {kGrey, kGrey, kGrey, 255});
    for (int y = 0; y < kRows_height; ++y) {
        for (int x = 0; x < kRows_width; ++x) {
            const int across = x - 60 - 3 * frame, down = y - 84;
            double shade = shadow == Shadow::kSoft ? soft_shadow(across, down) : 1;
            if (shadow == Shadow::kHard && std::abs(across) < 40 && std::abs(down) < 8) shade = 0.5;
            if (in_box(frame, x, y)) shade = 0.05;
            const std::uint8_t code = srgb8_from_linear(static_cast<float>(shade) * linear_from_srgb8(kGrey));
            image(x, y) = {code, code, code, 255};
        }
    }
    return image;
}

std::vector<Image<Rgba8>> frames_of(Shadow shadow) {
    std::vector<Image<Rgba8>> frames;
    for (int i = 0; i < kRows_frames; ++i) frames.push_back(frame_of(i, shadow));
    return frames;
}

Image<std::uint8_t> shadow_free_in(const std::vector<Image<Rgba8>>& frames) {
    return shadow_free_rows(ExposureNormalizedFrames(frames),
                            Image<Rgba8>(kRows_width, kRows_height, {kGrey, kGrey, kGrey, 255}), {});
}

// The first row that is not shadow-free; 0 for an empty mask.
int first_row(const Image<std::uint8_t>& shadow_free) {
    if (shadow_free.empty()) return 0;
    int y = 0;
    while (y < kRows_height && shadow_free(0, y) != 0) ++y;
    return y;
}

TEST(ShadowFreeRows, EndJustAboveTheHighestSoftShadow) {
    const Image<std::uint8_t> shadow_free = shadow_free_in(frames_of(Shadow::kSoft));
    ASSERT_FALSE(shadow_free.empty());
    const int ground = first_row(shadow_free);
    // A tenth of the light is missing up to 15 rows above its centre.
    EXPECT_GE(ground, 84 - 15 - 4);
    EXPECT_LE(ground, 84 - 5);
    for (int y = 0; y < kRows_height; ++y) {
        for (int x = 0; x < kRows_width; ++x) ASSERT_EQ(shadow_free(x, y), y < ground ? 255 : 0) << x << ", " << y;
    }
}

TEST(ShadowFreeRows, AreUnknownWithoutASoftShadow) {
    EXPECT_TRUE(shadow_free_in(frames_of(Shadow::kNone)).empty());
    EXPECT_TRUE(shadow_free_in(frames_of(Shadow::kHard)).empty());
}

// If the contour of the object has no contrast in a frame, a side of the object looks like a shadow.
TEST(ShadowFreeRows, IgnoreShadowsInFewFrames) {
    std::vector<Image<Rgba8>> frames = frames_of(Shadow::kSoft);
    const int ground = first_row(shadow_free_in(frames));
    const auto shade_top = [&](int frame) {
        for (int y = 0; y < 40; ++y) {
            for (int x = 0; x < kRows_width; ++x) {
                const double shade = soft_shadow(x - 80, y - 15);
                const std::uint8_t code = srgb8_from_linear(static_cast<float>(shade) * linear_from_srgb8(kGrey));
                frames[static_cast<std::size_t>(frame)](x, y) = {code, code, code, 255};
            }
        }
    };
    for (const int frame : {2, 7}) shade_top(frame);
    EXPECT_EQ(first_row(shadow_free_in(frames)), ground);
    shade_top(9);  // a quarter of them
    EXPECT_LT(first_row(shadow_free_in(frames)), 15);
}

}  // namespace
}  // namespace rs::capture
