#include "capture/photos/background/clean_plate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rs::capture {
namespace {

constexpr int kSwept_side = 120;
constexpr Rgba8 kWall{90, 100, 130, 255};
constexpr Rgba8 kBody{220, 220, 210, 255};
constexpr BackgroundParameters::SweptRegion kSweptRegionParameters{};

// A static body of revolution, x in 45..75 and y in 30..90, of which only two painted bands change.
bool in_body(int x, int y) {
    return x >= 45 && x < 75 && y >= 30 && y < 90;
}
bool in_bands(int x, int y) {
    return in_body(x, y) && ((y >= 40 && y < 56) || (y >= 66 && y < 86));
}

template <class Condition>
Image<std::uint8_t> mask_where(Condition condition) {
    Image<std::uint8_t> mask(kSwept_side, kSwept_side);
    for (int y = 0; y < kSwept_side; ++y) {
        for (int x = 0; x < kSwept_side; ++x) mask(x, y) = condition(x, y) ? 255 : 0;
    }
    return mask;
}

TEST(SweptRegion, EqualsMotionBeforeAUniformBackground) {
    const Image<Rgba8> colour(kSwept_side, kSwept_side, kWall);
    const auto disc = [](int x, int y) { return std::hypot(x - 60, y - 60) < 25; };
    const Image<std::uint8_t> region = swept_region(colour, mask_where(disc), kSweptRegionParameters);
    for (int y = 0; y < kSwept_side; ++y) {
        for (int x = 0; x < kSwept_side; ++x) {
            const double from_axis = std::hypot(x - 60, y - 60);
            if (from_axis < 24) {
                ASSERT_EQ(region(x, y), 255) << x << "," << y;
            } else if (from_axis > 36) {
                ASSERT_EQ(region(x, y), 0) << x << "," << y;
            }
        }
    }
}

TEST(SweptRegion, ContainsStaticPartsOfTheObject) {
    Image<Rgba8> colour(kSwept_side, kSwept_side, kWall);
    for (int y = 0; y < kSwept_side; ++y) {
        for (int x = 0; x < kSwept_side; ++x) {
            if (in_body(x, y)) colour(x, y) = kBody;
        }
    }
    const Image<std::uint8_t> region = swept_region(colour, mask_where(in_bands), kSweptRegionParameters);
    EXPECT_EQ(region(60, 60), 255) << "between the bands";
    EXPECT_EQ(region(48, 60), 255);
    EXPECT_EQ(region(60, 34), 255) << "the lip above them";
    EXPECT_EQ(region(30, 60), 0);
    EXPECT_EQ(region(60, 15), 0);
    EXPECT_EQ(region(60, 105), 0);
}

TEST(SweptRegion, ContainsALipNearTheImageBorder) {
    constexpr int kUp = 29;  // the body's top at y = 1
    Image<Rgba8> colour(kSwept_side, kSwept_side, kWall);
    for (int y = 0; y < kSwept_side; ++y) {
        for (int x = 0; x < kSwept_side; ++x) {
            if (in_body(x, y + kUp)) colour(x, y) = kBody;
        }
    }
    const Image<std::uint8_t> region =
        swept_region(colour, mask_where([](int x, int y) { return in_bands(x, y + kUp); }), kSweptRegionParameters);
    EXPECT_EQ(region(60, 2), 255);
    EXPECT_EQ(region(60, 8), 255);
    EXPECT_EQ(region(30, 3), 0);
}

TEST(SweptRegion, ContainsTheFootOfANarrowingBody) {
    const auto moves = [](int x, int y) { return y >= 30 && y < 86 && std::abs(x - 60) < (y < 70 ? 20 : 6); };
    Image<Rgba8> colour(kSwept_side, kSwept_side, kWall);
    for (int y = 0; y < kSwept_side; ++y) {
        for (int x = 0; x < kSwept_side; ++x) {
            if (moves(x, y) || (y >= 86 && y < 92 && std::abs(x - 60) < 6)) colour(x, y) = kBody;
        }
    }
    const Image<std::uint8_t> region = swept_region(colour, mask_where(moves), kSweptRegionParameters);
    EXPECT_EQ(region(60, 86), 255);
    EXPECT_EQ(region(70, 86), 0);
    EXPECT_EQ(region(60, 100), 0);
}

TEST(SweptRegion, IsEmptyWithoutMotion) {
    const Image<std::uint8_t> region = swept_region(Image<Rgba8>(kSwept_side, kSwept_side, kWall),
                                                    mask_where([](int, int) { return false; }), kSweptRegionParameters);
    EXPECT_EQ(std::count(region.pixels().begin(), region.pixels().end(), 0), kSwept_side * kSwept_side);
}

}  // namespace
}  // namespace rs::capture
