#include "capture/calibration/silhouettes/distance_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace rs::capture {
namespace {

float plainly_between(const Image<float>& field, float x, float y) {
    const int left = std::min(static_cast<int>(x), field.width() - 2);
    const int top = std::min(static_cast<int>(y), field.height() - 2);
    const float u = x - static_cast<float>(left), v = y - static_cast<float>(top);
    const float upper = (1 - u) * field(left, top) + u * field(left + 1, top);
    const float lower = (1 - u) * field(left, top + 1) + u * field(left + 1, top + 1);
    return (1 - v) * upper + v * lower;
}

TEST(DistanceField, EqualsItsSamplesToHalfAUnit) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> any_px(-200, 200), share(0, 1);
    for (const auto& [width, height] : {std::pair{2, 2}, {7, 3}, {8, 4}, {9, 5}, {16, 8}, {33, 21}}) {
        Image<float> samples(width, height);
        for (float& each : samples.pixels()) each = any_px(random);
        const DistanceField field(samples.view());
        for (int i = 0; i < 500; ++i) {
            const float x = share(random) * static_cast<float>(width - 1);
            const float y = share(random) * static_cast<float>(height - 1);
            EXPECT_NEAR(field.at(x, y), plainly_between(samples, x, y), 0.5 / 128 + 1e-4);
        }
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                EXPECT_NEAR(field.at(static_cast<float>(x), static_cast<float>(y)), samples(x, y), 0.5 / 128 + 1e-5);
            }
        }
    }
}

TEST(DistanceField, CutsOffWhatIsFarAway) {
    Image<float> samples(2, 2);
    std::fill(samples.pixels().begin(), samples.pixels().end(), -1000.0F);
    EXPECT_EQ(DistanceField(samples.view()).at(0.5F, 0.5F), -256);
    std::fill(samples.pixels().begin(), samples.pixels().end(), 1000.0F);
    EXPECT_NEAR(DistanceField(samples.view()).at(0.5F, 0.5F), 256, 0.01);
}

}  // namespace
}  // namespace rs::capture
