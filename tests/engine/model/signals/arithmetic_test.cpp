// Divider and multiplier of the hardware, step by step, compared with the operations of RECONSTRUCTION.md.

#include "engine/model/signals/arithmetic.hpp"
#include "engine/core/definition/fixed_point.hpp"
#include "engine/model/blocks/shared/colour_conversion.hpp"
#include "rayspace/object/yuv.hpp"

#include <gtest/gtest.h>

#include <random>

namespace rs::engine::model {
namespace {

TEST(ArithmeticProperty, QuotientsAreFloorsOrOverflow) {
    std::mt19937_64 random(1);
    int overflows = 0;
    for (int n = 0; n < 200'000; ++n) {
        const std::int64_t dividend = static_cast<std::int64_t>(random()) >> (1 + random() % 62);
        const auto divisor = static_cast<std::int64_t>((random() >> (32 + random() % 31)) | 1U);
        const Quotient serial = divide_serially(dividend, divisor);
        const Quotient quick = divide(dividend, divisor);
        ASSERT_EQ(serial.overflow, quick.overflow) << dividend << " / " << divisor;
        ASSERT_EQ(serial.value, quick.value) << dividend << " / " << divisor;
        overflows += serial.overflow;
        if (!serial.overflow) {
            ASSERT_EQ(serial.value, floor_divide(dividend, divisor));
        }
    }
    EXPECT_GT(overflows, 1000);
    EXPECT_LT(overflows, 150'000);
}

TEST(Arithmetic, OverflowBeginsAtTwoToTheThirtyTwo) {
    constexpr std::int64_t kLimit = std::int64_t{1} << 32;
    for (const std::int64_t d : {1, 3, 1 << 24}) {
        EXPECT_FALSE(divide_serially(kLimit * d - 1, d).overflow);
        EXPECT_TRUE(divide_serially(kLimit * d, d).overflow);
        EXPECT_FALSE(divide_serially(-kLimit * d + 1, d).overflow);
        EXPECT_TRUE(divide_serially(-kLimit * d, d).overflow);
    }
}

TEST(ArithmeticProperty, ProductsOfNineStepsAreProducts) {
    std::mt19937_64 random(2);
    for (int n = 0; n < 100'000; ++n) {
        const std::int64_t b = static_cast<std::int64_t>(random()) >> (29 + random() % 30);
        const std::int64_t a = static_cast<std::int64_t>(random()) >> (36 + random() % 20);
        ASSERT_EQ(multiply_serially(a, b), a * b) << a << " * " << b;
    }
}

TEST(Colour, AllAlphaLevelsAreThoseOfTheDefinition) {
    for (int level = 0; level < 4; ++level) {
        for (int n = 0; n < 4096; ++n) {
            const YuvaPixel pixel{0, n & 255, (n * 7) & 255, (n * 13) & 255, 85 * level};
            const Rgba8 c = rgba_from_yuva(pixel.y, pixel.u, pixel.v, (level * 255 + 1) / 3);
            const std::uint32_t word = convert_to_rgba(pixel);
            ASSERT_EQ(word, static_cast<std::uint32_t>(c.r) | static_cast<std::uint32_t>(c.g) << 8U |
                                static_cast<std::uint32_t>(c.b) << 16U | static_cast<std::uint32_t>(c.a) << 24U);
        }
    }
}

TEST(Arithmetic, MeansOfDepthsAreThoseOfDivision) {
    for (int weight = 1; weight <= 64; ++weight) {
        const int most = 8 * 255 * weight + weight / 2;
        int wrong = 0;
        for (int sum = 0; sum <= most; ++sum) wrong += divide_by_weight(sum, weight) != sum / weight ? 1 : 0;
        EXPECT_EQ(wrong, 0) << weight;
    }
}

}  // namespace
}  // namespace rs::engine::model
