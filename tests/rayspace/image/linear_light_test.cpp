#include "rayspace/image/linear_light.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rs {
namespace {

std::uint8_t by_curve(float linear) {
    return static_cast<std::uint8_t>(std::lround(srgb_from_linear(linear) * 255.0F));
}

TEST(SrgbCodes, CodesByTableAreThoseOfTheCurve) {
    for (int i = 1; i < 200'000; ++i) {
        const float linear = static_cast<float>(i) / 200'000.0F;
        ASSERT_EQ(srgb8_by_table(linear), by_curve(linear)) << linear;
    }
    // At the thresholds of codes, and a few floats to either side.
    for (int code = 1; code < 256; ++code) {
        float linear = linear_from_srgb((static_cast<float>(code) - 0.5F) / 255.0F);
        for (int i = 0; i < 20; ++i) linear = std::nextafter(linear, 0.0F);
        for (int i = 0; i < 40; ++i, linear = std::nextafter(linear, 1.0F)) {
            ASSERT_EQ(srgb8_by_table(linear), by_curve(linear)) << linear;
        }
    }
    for (int code = 0; code < 256; ++code) {
        EXPECT_EQ(srgb8_by_table(linear_from_srgb8(static_cast<std::uint8_t>(code))), code);
    }
}

TEST(SrgbCodes, CodesOfWhatIsOutOfRange) {
    EXPECT_EQ(srgb8_by_table(-1), 0);
    EXPECT_EQ(srgb8_by_table(0), 0);
    EXPECT_EQ(srgb8_by_table(std::numeric_limits<float>::denorm_min()), 0);
    EXPECT_EQ(srgb8_by_table(std::nextafter(1.0F, 0.0F)), 255);
    EXPECT_EQ(srgb8_by_table(1), 255);
    EXPECT_EQ(srgb8_by_table(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(srgb8_by_table(std::numeric_limits<float>::quiet_NaN()), 0);
}

}  // namespace
}  // namespace rs
