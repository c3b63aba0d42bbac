#include "engine/core/definition/mix_rings.hpp"

#include <gtest/gtest.h>

#include <random>

namespace rs::engine {
namespace {

TEST(MixRings, WeightsOfZeroAndAllReturnOneImage) {
    std::mt19937 random(1);
    for (int n = 0; n < 1000; ++n) {
        const auto byte = [&] { return static_cast<std::uint8_t>(random()); };
        const Rgba8 a{byte(), byte(), byte(), static_cast<std::uint8_t>(1 + random() % 255)};
        const Rgba8 b{byte(), byte(), byte(), byte()};
        EXPECT_EQ(mix_pixels(a, b, 0), a);
        EXPECT_EQ(mix_pixels(b, a, 256), a);
        EXPECT_EQ(mix_pixels(a, a, static_cast<int>(random() % 257)), a);
    }
}

TEST(MixRings, ColoursAreWeightedByAlpha) {
    EXPECT_EQ(mix_pixels({200, 0, 0, 255}, {0, 0, 0, 0}, 64), (Rgba8{200, 0, 0, 191}));
    EXPECT_EQ(mix_pixels({200, 100, 0, 255}, {0, 100, 200, 255}, 128), (Rgba8{100, 100, 100, 255}));
    EXPECT_EQ(mix_pixels({200, 0, 0, 1}, {0, 0, 0, 0}, 200), Rgba8{});
}

TEST(MixRings, DepthIsThatOfTheLargerShare) {
    Image<Rgba8> nearest(3, 1, Rgba8{9, 9, 9, 255});
    nearest(1, 0).a = 0;
    nearest(2, 0).a = 10;
    const Image<Rgba8> second(3, 1, Rgba8{9, 9, 9, 255});
    Image<std::int32_t> depth(3, 1, 100);
    depth(1, 0) = 0;
    const Image<std::int32_t> second_depth(3, 1, 200);
    mix_rings(nearest, depth, second, second_depth, 100);
    EXPECT_EQ(depth(0, 0), 100);
    EXPECT_EQ(depth(1, 0), 200);
    EXPECT_EQ(depth(2, 0), 200);
}

}  // namespace
}  // namespace rs::engine
