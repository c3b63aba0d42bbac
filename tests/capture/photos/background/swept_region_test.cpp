#include "capture/photos/background/swept_region.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rs::capture {
namespace {

constexpr int kSide = 120;
constexpr Rgba8 kWall{90, 100, 130, 255};
constexpr Rgba8 kBody{220, 220, 210, 255};

// A still body of revolution, x in 45..75 and y in 30..90, of which only two painted bands move.
bool in_body(int x, int y) {
    return x >= 45 && x < 75 && y >= 30 && y < 90;
}
bool in_bands(int x, int y) {
    return in_body(x, y) && ((y >= 40 && y < 56) || (y >= 66 && y < 86));
}

template <class Condition>
Image<std::uint8_t> mask_where(Condition condition) {
    Image<std::uint8_t> mask(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) mask(x, y) = condition(x, y) ? 255 : 0;
    }
    return mask;
}

TEST(SweptRegion, IsWhatMovesWhereTheBackdropIsEven) {
    const Image<Rgba8> still(kSide, kSide, kWall);
    const auto disc = [](int x, int y) { return std::hypot(x - 60, y - 60) < 25; };
    const Image<std::uint8_t> region = swept_region(still, mask_where(disc)).mask;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const double from_axis = std::hypot(x - 60, y - 60);
            if (from_axis < 24) {
                ASSERT_EQ(region(x, y), 255) << x << "," << y;
            } else if (from_axis > 36) {
                ASSERT_EQ(region(x, y), 0) << x << "," << y;
            }
        }
    }
}

TEST(SweptRegion, HoldsTheStillPartsOfTheObject) {
    Image<Rgba8> still(kSide, kSide, kWall);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            if (in_body(x, y)) still(x, y) = kBody;
        }
    }
    const Image<std::uint8_t> region = swept_region(still, mask_where(in_bands)).mask;
    EXPECT_EQ(region(60, 60), 255) << "between the bands";
    EXPECT_EQ(region(48, 60), 255);
    EXPECT_EQ(region(60, 34), 255) << "the lip above them";
    EXPECT_EQ(region(30, 60), 0);
    EXPECT_EQ(region(60, 15), 0);
    EXPECT_EQ(region(60, 105), 0);
}

TEST(SweptRegion, HoldsALipNearThePicturesBorder) {
    constexpr int kUp = 29;  // the body's top at y = 1
    Image<Rgba8> still(kSide, kSide, kWall);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            if (in_body(x, y + kUp)) still(x, y) = kBody;
        }
    }
    const Image<std::uint8_t> region =
        swept_region(still, mask_where([](int x, int y) { return in_bands(x, y + kUp); })).mask;
    EXPECT_EQ(region(60, 2), 255);
    EXPECT_EQ(region(60, 8), 255);
    EXPECT_EQ(region(30, 3), 0);
}

TEST(SweptRegion, HoldsTheFootOfWhatIsNarrowBelow) {
    const auto moves = [](int x, int y) { return y >= 30 && y < 86 && std::abs(x - 60) < (y < 70 ? 20 : 6); };
    Image<Rgba8> still(kSide, kSide, kWall);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            if (moves(x, y) || (y >= 86 && y < 92 && std::abs(x - 60) < 6)) still(x, y) = kBody;
        }
    }
    const Image<std::uint8_t> region = swept_region(still, mask_where(moves)).mask;
    EXPECT_EQ(region(60, 86), 255);
    EXPECT_EQ(region(70, 86), 0);
    EXPECT_EQ(region(60, 100), 0);
}

TEST(SweptRegion, IsEmptyWhereNothingMoves) {
    const Image<std::uint8_t> region =
        swept_region(Image<Rgba8>(kSide, kSide, kWall), mask_where([](int, int) { return false; })).mask;
    EXPECT_EQ(std::count(region.pixels().begin(), region.pixels().end(), 0), kSide * kSide);
}

}  // namespace
}  // namespace rs::capture
