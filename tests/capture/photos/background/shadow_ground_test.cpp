// Where an object throws its shadow.

#include "capture/photos/background/shadow_ground.hpp"

#include "capture/photos/background/evened_samples.hpp"
#include "rayspace/image/linear_light.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kWidth = 160, kHeight = 120, kSamples = 12;
constexpr std::uint8_t kGrey = 190;

// A dark box that stands on row 80 and moves to the right from sample to sample.
bool in_box(int sample, int x, int y) {
    return std::abs(x - 60 - 3 * sample) < 16 && y >= 30 && y < 80;
}

// What a soft shadow around (x, y) leaves of the light.
double beside_shadow(double x, double y) {
    return 1 - 0.5 * std::exp(-std::pow(x / 30, 2) - std::pow(y / 12, 2));
}

enum class Shadow { kNone, kSoft, kHard };

Image<Rgba8> sample_of(int sample, Shadow shadow) {
    Image<Rgba8> picture(kWidth, kHeight, {kGrey, kGrey, kGrey, 255});
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const int across = x - 60 - 3 * sample, down = y - 84;
            double share = shadow == Shadow::kSoft ? beside_shadow(across, down) : 1;
            if (shadow == Shadow::kHard && std::abs(across) < 40 && std::abs(down) < 8) share = 0.5;
            if (in_box(sample, x, y)) share = 0.05;
            const std::uint8_t code = srgb8_from_linear(static_cast<float>(share) * linear_from_srgb8(kGrey));
            picture(x, y) = {code, code, code, 255};
        }
    }
    return picture;
}

std::vector<Image<Rgba8>> samples_of(Shadow shadow) {
    std::vector<Image<Rgba8>> samples;
    for (int i = 0; i < kSamples; ++i) samples.push_back(sample_of(i, shadow));
    return samples;
}

Image<std::uint8_t> above_in(const std::vector<Image<Rgba8>>& samples) {
    return above_shadows(EvenedSamples(samples), Image<Rgba8>(kWidth, kHeight, {kGrey, kGrey, kGrey, 255}));
}

// The first row that is not above; 0 of nothing.
int first_row(const Image<std::uint8_t>& above) {
    if (above.empty()) return 0;
    int y = 0;
    while (y < kHeight && above(0, y) != 0) ++y;
    return y;
}

TEST(AboveShadows, EndALittleAboveTheHighestSoftShadow) {
    const Image<std::uint8_t> above = above_in(samples_of(Shadow::kSoft));
    ASSERT_FALSE(above.empty());
    const int ground = first_row(above);
    // A tenth of the light is missing up to 15 rows above its middle.
    EXPECT_GE(ground, 84 - 15 - 4);
    EXPECT_LE(ground, 84 - 5);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) ASSERT_EQ(above(x, y), y < ground ? 255 : 0) << x << ", " << y;
    }
}

TEST(AboveShadows, AreUnknownWithoutASoftShadow) {
    EXPECT_TRUE(above_in(samples_of(Shadow::kNone)).empty());
    EXPECT_TRUE(above_in(samples_of(Shadow::kHard)).empty());
}

// An outline that vanishes in a picture makes a side of the object look like a shadow there.
TEST(AboveShadows, AFewPicturesAreNotBelieved) {
    std::vector<Image<Rgba8>> samples = samples_of(Shadow::kSoft);
    const int ground = first_row(above_in(samples));
    const auto shade_top = [&](int sample) {
        for (int y = 0; y < 40; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const double share = beside_shadow(x - 80, y - 15);
                const std::uint8_t code = srgb8_from_linear(static_cast<float>(share) * linear_from_srgb8(kGrey));
                samples[static_cast<std::size_t>(sample)](x, y) = {code, code, code, 255};
            }
        }
    };
    for (const int sample : {2, 7}) shade_top(sample);
    EXPECT_EQ(first_row(above_in(samples)), ground);
    shade_top(9);  // a quarter of them
    EXPECT_LT(first_row(above_in(samples)), 15);
}

}  // namespace
}  // namespace rs::capture
