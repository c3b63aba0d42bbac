#include "capture/photos/intake/exposure.hpp"

#include "capture/photos/background/exposure_normalized_frames.hpp"
#include "rayspace/image/linear_light.hpp"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kExposedWidth = 90;
constexpr int kExposedHeight = 60;
constexpr int kObject_px = 30;  // columns before this show the object

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

TEST(ExposureGain, IsMeasuredPerChannelOnStaticPixels) {
    const LinearRgb gain =
        exposure_gain(photo_of({1.2F, 1, 0.8F}, 200), light_of(photo_of({1, 1, 1}, 60)), still_part());
    EXPECT_NEAR(gain.r, 1.2, 0.02);
    EXPECT_NEAR(gain.g, 1, 0.02);
    EXPECT_NEAR(gain.b, 0.8, 0.02);
}

TEST(ExposureGain, IsClampedAndIsOneIfNothingCanBeMeasured) {
    EXPECT_FLOAT_EQ(exposure_gain(photo_of({2.6F, 1, 1}, 0), light_of(photo_of({1, 1, 1}, 0)), still_part()).r, 2);
    const Image<Rgba8> clipped(kExposedWidth, kExposedHeight, Rgba8{255, 255, 20, 255});
    const LinearRgb gain = exposure_gain(clipped, light_of(photo_of({1, 1, 1}, 0)), still_part());
    EXPECT_FLOAT_EQ(gain.r, 1);
    EXPECT_FLOAT_EQ(gain.b, 1);
}

TEST(ExposureNormalizedFrames, HaveOneExposureAndKeepClippedValues) {
    std::vector<Image<Rgba8>> photos;
    for (const float gain : {0.85F, 1.0F, 1.15F}) photos.push_back(photo_of({gain, gain, gain}, 255));
    ExposureNormalizedFrames samples(photos);
    EXPECT_GT(std::abs(samples(0, 60, 30).g - samples(2, 60, 30).g), 10);
    EXPECT_FALSE(samples.normalize(photo_of({1, 1, 1}, 255), still_part(), 2)) << "the exposures hardly differ";
    EXPECT_EQ(samples(0, 60, 30), photos[0](60, 30));
    EXPECT_TRUE(samples.normalize(photo_of({1, 1, 1}, 255), still_part()));
    EXPECT_FALSE(samples.normalize(photo_of({1, 1, 1}, 255), still_part())) << "already normalized";
    for (int x = kObject_px; x < kExposedWidth; ++x) {
        for (std::size_t i = 0; i < samples.count(); ++i) {
            ASSERT_NEAR(samples(i, x, 30).g, photos[1](x, 30).g, 2) << i << " at " << x;
        }
    }
    EXPECT_EQ(samples(2, 5, 5), (Rgba8{255, 255, 255, 255}));
}

TEST(ExposureNormalizedFrames, SmoothAveragesThreeByThreePixels) {
    std::vector<Image<Rgba8>> photos(1, Image<Rgba8>(9, 9, Rgba8{100, 100, 100, 255}));
    photos[0](4, 4) = {164, 100, 100, 255};
    const ExposureNormalizedFrames samples(photos);
    EXPECT_EQ(samples.smooth(0, 4, 4), (Rgba8{116, 100, 100, 255}));
    EXPECT_EQ(samples.smooth(0, 5, 5), (Rgba8{104, 100, 100, 255}));
    EXPECT_EQ(samples.smooth(0, 6, 4), (Rgba8{100, 100, 100, 255}));
    EXPECT_EQ(samples(0, 4, 4), photos[0](4, 4));
}

// Equals its definition at the image border and at block boundaries.
TEST(ExposureNormalizedFrames, SmoothEqualsItsDefinitionEverywhere) {
    std::minstd_rand random(3);
    std::uniform_int_distribution<int> code(0, 255);
    std::vector<Image<Rgba8>> photos;
    for (const auto& [width, height] : {std::pair(7, 75), {5, 33}, {1, 64}, {9, 1}}) {
        photos.assign(3, Image<Rgba8>(width, height));
        for (Image<Rgba8>& photo : photos) {
            const auto any = [&] { return static_cast<std::uint8_t>(code(random)); };
            for (Rgba8& p : photo.pixels()) p = {any(), any(), any(), 255};
        }
        const ExposureNormalizedFrames samples(photos);
        for (std::size_t i = 0; i < photos.size(); ++i) {
            for (int y = 0; y < height; ++y) {
                for (int x = 0; x < width; ++x) {
                    cv::Vec3i sum = cv::Vec3i::all(8);  // half of the weights
                    for (int dy = -1; dy <= 1; ++dy) {
                        for (int dx = -1; dx <= 1; ++dx) {
                            const Rgba8& p =
                                photos[i](std::clamp(x + dx, 0, width - 1), std::clamp(y + dy, 0, height - 1));
                            sum += (2 - std::abs(dx)) * (2 - std::abs(dy)) * cv::Vec3i(p.r, p.g, p.b);
                        }
                    }
                    const Rgba8 smooth = samples.smooth(i, x, y);
                    ASSERT_EQ(cv::Vec3i(smooth.r, smooth.g, smooth.b), cv::Vec3i(sum[0] / 16, sum[1] / 16, sum[2] / 16))
                        << i << ": " << x << ", " << y;
                }
            }
        }
    }
}

TEST(ExposureDivisionTable, DividesLinearLightAndKeepsClippedCodes) {
    const auto half = exposure_division_table(2);
    EXPECT_EQ(half[0], 0);
    EXPECT_EQ(half[188], 137);  // linear 0.503 and 0.251
    EXPECT_EQ(half[255], 255);
    const auto same = exposure_division_table(1);
    for (std::size_t code = 0; code < same.size(); ++code) EXPECT_EQ(same[code], code);
    EXPECT_EQ(exposure_division_table(0.25F)[200], 255);
}

}  // namespace
}  // namespace rs::capture
