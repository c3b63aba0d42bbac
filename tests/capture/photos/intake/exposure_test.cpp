#include "capture/photos/intake/exposure.hpp"

#include "capture/photos/background/evened_samples.hpp"
#include "rayspace/image/linear_light.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

namespace rs::capture {
namespace {

constexpr int kExposedWidth = 90;
constexpr int kExposedHeight = 60;
constexpr int kObject_px = 30;  // the columns before this show something else

Image<Rgba8> photo_of(const std::array<float, 3>& gain, std::uint8_t object) {
    Image<Rgba8> photo(kExposedWidth, kExposedHeight);
    for (int y = 0; y < kExposedHeight; ++y) {
        for (int x = 0; x < kExposedWidth; ++x) {
            const auto code = static_cast<std::uint8_t>(80 + x / 2 + y / 2);
            const auto exposed = [&](std::size_t i) { return srgb8_from_linear(gain[i] * linear_from_srgb8(code)); };
            photo(x, y) =
                x < kObject_px ? Rgba8{object, object, object, 255} : Rgba8{exposed(0), exposed(1), exposed(2), 255};
        }
    }
    return photo;
}

Image<std::uint8_t> still_part() {
    Image<std::uint8_t> still(kExposedWidth, kExposedHeight);
    for (int y = 0; y < kExposedHeight; ++y) {
        for (int x = kObject_px; x < kExposedWidth; ++x) still(x, y) = 255;
    }
    return still;
}

Image<LinearRgb> light_of(const Image<Rgba8>& photo) {
    Image<LinearRgb> light(photo.width(), photo.height());
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) light(x, y) = linear_rgb(photo(x, y));
    }
    return light;
}

TEST(ExposureGain, IsFoundPerChannelWhereNothingMoves) {
    const LinearRgb gain =
        exposure_gain(photo_of({1.2F, 1, 0.8F}, 200), light_of(photo_of({1, 1, 1}, 60)), still_part());
    EXPECT_NEAR(gain.r, 1.2, 0.02);
    EXPECT_NEAR(gain.g, 1, 0.02);
    EXPECT_NEAR(gain.b, 0.8, 0.02);
}

TEST(ExposureGain, IsKeptWithinItsBoundsAndIsOneWhereNothingCanBeMeasured) {
    EXPECT_FLOAT_EQ(exposure_gain(photo_of({2.6F, 1, 1}, 0), light_of(photo_of({1, 1, 1}, 0)), still_part()).r, 2);
    const Image<Rgba8> clipped(kExposedWidth, kExposedHeight, Rgba8{255, 255, 20, 255});
    const LinearRgb gain = exposure_gain(clipped, light_of(photo_of({1, 1, 1}, 0)), still_part());
    EXPECT_FLOAT_EQ(gain.r, 1);
    EXPECT_FLOAT_EQ(gain.b, 1);
}

TEST(EvenedSamples, LookExposedAlikeAndKeepClippedValues) {
    std::vector<Image<Rgba8>> photos;
    for (const float gain : {0.85F, 1.0F, 1.15F}) photos.push_back(photo_of({gain, gain, gain}, 255));
    EvenedSamples samples(photos);
    EXPECT_GT(std::abs(samples(0, 60, 30).g - samples(2, 60, 30).g), 10);
    samples.even_out(photo_of({1, 1, 1}, 255), still_part());
    for (int x = kObject_px; x < kExposedWidth; ++x) {
        for (std::size_t i = 0; i < samples.count(); ++i) {
            ASSERT_NEAR(samples(i, x, 30).g, photos[1](x, 30).g, 2) << i << " at " << x;
        }
    }
    EXPECT_EQ(samples(2, 5, 5), (Rgba8{255, 255, 255, 255}));
}

TEST(EvenedSamples, SmoothAveragesThreeByThreePixels) {
    std::vector<Image<Rgba8>> photos(1, Image<Rgba8>(9, 9, Rgba8{100, 100, 100, 255}));
    photos[0](4, 4) = {164, 100, 100, 255};
    const EvenedSamples samples(photos);
    EXPECT_EQ(samples.smooth(0, 4, 4), (Rgba8{116, 100, 100, 255}));
    EXPECT_EQ(samples.smooth(0, 5, 5), (Rgba8{104, 100, 100, 255}));
    EXPECT_EQ(samples.smooth(0, 6, 4), (Rgba8{100, 100, 100, 255}));
    EXPECT_EQ(samples(0, 4, 4), photos[0](4, 4));
}

}  // namespace
}  // namespace rs::capture
