#include "encode/set/soft_coverage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace rs::encode {
namespace {

// Tests every patch that may contain a sample.
bool is_in_patch(const Image<std::uint8_t>& alpha, int radius, int x, int y) {
    const int side = 2 * radius + 1;
    for (int top = y - side + 1; top <= y; ++top) {
        for (int left = x - side + 1; left <= x; ++left) {
            if (left < 0 || top < 0 || left + side > alpha.width() || top + side > alpha.height()) continue;
            bool all = true;
            for (int i = 0; i < side * side; ++i) {
                const int a = alpha(left + i % side, top + i / side);
                all = all && a >= kMinVisibleAlpha && a <= 255 - kMinVisibleAlpha;
            }
            if (all) return true;
        }
    }
    return false;
}

TEST(SoftCoverage, PatchesAreWhereAllSamplesAreSoft) {
    std::mt19937 random(1);
    for (const int radius : {1, 2, 4}) {
        Image<std::uint8_t> alpha(37, 29);
        // Mostly soft, so that patches of all shapes occur.
        for (std::uint8_t& a : alpha.pixels()) {
            const auto number = static_cast<int>(random() % 300);
            a = number < 4 * radius
                    ? static_cast<std::uint8_t>(random() % 2 * 255)
                    : static_cast<std::uint8_t>(kMinVisibleAlpha + number % (256 - 2 * kMinVisibleAlpha));
        }
        const Image<std::uint8_t> patches = find_soft_patches(alpha, radius);
        int inside = 0;
        for (int y = 0; y < alpha.height(); ++y) {
            for (int x = 0; x < alpha.width(); ++x) {
                ASSERT_EQ(patches(x, y), is_in_patch(alpha, radius, x, y) ? 255 : 0) << x << " " << y;
                inside += patches(x, y) != 0 ? 1 : 0;
            }
        }
        EXPECT_GT(inside, 20);
        EXPECT_LT(inside, 37 * 29 - 20);
    }
}

TEST(SoftCoverage, TheRimOfACutOutIsNone) {
    Image<std::uint8_t> alpha(64, 64);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const double inside = 20 - std::hypot(x - 31.5, y - 31.5);
            alpha(x, y) = static_cast<std::uint8_t>(std::clamp(128 + 64 * inside, 0.0, 255.0));  // 4 px wide
        }
    }
    const Image<std::uint8_t> patches = find_soft_patches(alpha, 2);
    EXPECT_EQ(std::ranges::count(patches.pixels(), 255), 0);
}

TEST(SoftCoverage, ImagesSmallerThanAPatchHaveNone) {
    const Image<std::uint8_t> patches = find_soft_patches(Image<std::uint8_t>(8, 3, 100), 2);
    EXPECT_EQ(patches, Image<std::uint8_t>(8, 3));
    EXPECT_TRUE(find_soft_patches(Image<std::uint8_t>(), 2).empty());
}

}  // namespace
}  // namespace rs::encode
