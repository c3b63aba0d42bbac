// Tests of the integer operations of the normative arithmetic against wider arithmetic.
#include "engine/core/definition/fixed_point.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace rs::engine {
namespace {

using Wide = __int128;
constexpr std::int64_t kHighest = std::numeric_limits<std::int64_t>::max();

void expect_root(std::int64_t square) {
    const std::int64_t root = floor_square_root(square);
    EXPECT_GE(root, 0) << square;
    EXPECT_LE(Wide{root} * root, square) << square;
    EXPECT_GT(Wide{root + 1} * (root + 1), square) << square;
}

TEST(FloorSquareRoot, AtTheLimitsOfItsRange) {
    for (const std::int64_t square : {0, 1, 2, 3, 4, 8, 9}) expect_root(square);
    constexpr std::int64_t kLargestRoot = 3'037'000'499;
    for (const std::int64_t below : {0, 1, 2}) {
        expect_root(kHighest - below);
        expect_root(kLargestRoot * kLargestRoot - below);
        expect_root(kLargestRoot * kLargestRoot + below);
    }
    EXPECT_EQ(floor_square_root(kHighest), kLargestRoot);
}

// A double has 53 bits: near the squares of large numbers its root can round to the wrong integer.
TEST(FloorSquareRootProperty, AroundSquares) {
    std::mt19937_64 random(1);
    for (int trial = 0; trial < 20000; ++trial) {
        const auto root = static_cast<std::int64_t>(random() % 3'037'000'499 >> (random() % 31));
        for (const std::int64_t beside : {-1, 0, 1}) {
            if (root * root + beside >= 0) expect_root(root * root + beside);
        }
        expect_root(static_cast<std::int64_t>(random() >> (1 + random() % 62)));
    }
}

TEST(FloorDivideProperty, RoundsTowardsMinusInfinity) {
    std::mt19937_64 random(2);
    for (int trial = 0; trial < 20000; ++trial) {
        const auto dividend = static_cast<std::int64_t>(random()) >> (1 + random() % 60);
        const auto divisor = static_cast<std::int64_t>(random() >> (1 + random() % 60)) + 1;
        const std::int64_t quotient = floor_divide(dividend, divisor);
        EXPECT_LE(Wide{quotient} * divisor, dividend);
        EXPECT_GT((Wide{quotient} + 1) * divisor, dividend);
    }
    EXPECT_EQ(floor_divide(-6, 3), -2);
    EXPECT_EQ(floor_divide(-7, 3), -3);
    EXPECT_EQ(floor_divide(7, 3), 2);
}

TEST(MultiplyShiftProperty, IsTheExactProductShiftedAndHeld) {
    const auto expected = [](std::int32_t a, std::int32_t b, int shift) {
        const Wide product = Wide{a} * b;
        const Wide divisor = Wide{1} << shift;
        Wide quotient = product / divisor;
        if (quotient * divisor > product) --quotient;
        const Wide highest = (Wide{1} << 29) - 1;
        return static_cast<std::int32_t>(quotient > highest        ? highest
                                         : quotient < -highest - 1 ? -highest - 1
                                                                   : quotient);
    };
    constexpr std::int32_t kEdges[] = {
        std::numeric_limits<std::int32_t>::min(), -(1 << 29) - 1, -(1 << 29), -1, 0, 1, (1 << 29) - 1, 1 << 29,
        std::numeric_limits<std::int32_t>::max()};
    for (const int shift : {0, 12, 16, 24, 28}) {
        for (const std::int32_t a : kEdges) {
            for (const std::int32_t b : kEdges)
                EXPECT_EQ(multiply_shift(a, b, shift), expected(a, b, shift)) << a << " " << b;
        }
    }
    std::mt19937_64 random(3);
    for (int trial = 0; trial < 20000; ++trial) {
        const auto a = static_cast<std::int32_t>(random()) >> (random() % 31);
        const auto b = static_cast<std::int32_t>(random()) >> (random() % 31);
        const int shift = static_cast<int>(random() % 29);
        EXPECT_EQ(multiply_shift(a, b, shift), expected(a, b, shift)) << a << " " << b << " " << shift;
    }
}

}  // namespace
}  // namespace rs::engine
