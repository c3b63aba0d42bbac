#include "capture/photos/background/clean_plate_growth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kPlateWidth = 80;
constexpr int kPlateHeight = 48;
constexpr int kSeedColumns = 12;  // at either side

Rgba8 backdrop_at(int x, int y) {
    const auto code = static_cast<std::uint8_t>(110 + x / 4 + y / 4);
    return {code, static_cast<std::uint8_t>(code - 20), 90, 255};
}

constexpr Rgba8 kObject{210, 40, 60, 255};

// A bar of the object stands somewhere else in each picture, a post always in the middle.
std::vector<Image<Rgba8>> bars_and_a_post() {
    constexpr int kViews = 12;
    std::vector<Image<Rgba8>> samples;
    for (int i = 0; i < kViews; ++i) {
        Image<Rgba8> sample(kPlateWidth, kPlateHeight);
        const int bar = 16 + 4 * i;
        for (int y = 0; y < kPlateHeight; ++y) {
            for (int x = 0; x < kPlateWidth; ++x) {
                const bool object = (x >= bar && x < bar + 6) || (x >= 36 && x < 44 && y >= 10);
                sample(x, y) = object ? kObject : backdrop_at(x, y);
            }
        }
        samples.push_back(sample);
    }
    return samples;
}

Image<std::uint8_t> seeds(bool right = true) {
    Image<std::uint8_t> mask(kPlateWidth, kPlateHeight);
    for (int y = 0; y < kPlateHeight; ++y) {
        for (int x = 0; x < kSeedColumns; ++x)
            mask(x, y) = mask(kPlateWidth - 1 - (right ? x : kPlateWidth - 1 - x), y) = 255;
    }
    return mask;
}

GrownCleanPlate grown(const EvenedSamples& samples, const Image<Rgba8>& guess, const Image<std::uint8_t>& seeds,
                      const Image<std::uint8_t>& barred = Image<std::uint8_t>(kPlateWidth, kPlateHeight)) {
    GrownCleanPlate plate;
    grow_plate(samples, guess, seeds, barred, plate);
    return plate;
}

TEST(GrowPlate, FollowsTheBackdropBehindWhatMovesAndStopsAtWhatHidesIt) {
    const std::vector<Image<Rgba8>> photos = bars_and_a_post();
    const EvenedSamples samples(photos);
    const GrownCleanPlate plate = grown(samples, photos[0], seeds());
    const Image<Rgba8> sharp = sharp_colours(samples, plate);
    for (int y = 0; y < kPlateHeight; ++y) {
        for (int x = 0; x < kPlateWidth; ++x) {
            const bool post = x >= 36 && x < 44 && y >= 10;
            if (post) {
                ASSERT_EQ(plate.witnesses(x, y), 0U) << x << "," << y;
            } else if (x < 34 || x >= 46) {
                ASSERT_NE(plate.witnesses(x, y), 0U) << x << "," << y;
                ASSERT_NEAR(sharp(x, y).r, backdrop_at(x, y).r, 3) << x << "," << y;
            }
        }
    }
    EXPECT_EQ(plate.witnesses(18, 24) & 1U, 0U) << "the first picture shows its bar there";
    EXPECT_NE(plate.witnesses(18, 24) & 0x800U, 0U) << "the last one the backdrop";
}

TEST(GrowPlate, KeepsOutOfWhatIsBarred) {
    const std::vector<Image<Rgba8>> photos = bars_and_a_post();
    const EvenedSamples samples(photos);
    Image<std::uint8_t> barred(kPlateWidth, kPlateHeight);
    for (int y = 20; y < 30; ++y) {
        for (int x = 20; x < 30; ++x) barred(x, y) = 255;
    }
    const GrownCleanPlate plate = grown(samples, photos[0], seeds(), barred);
    EXPECT_EQ(plate.witnesses(25, 25), 0U);
    EXPECT_NE(plate.witnesses(25, 15), 0U);
}

// The object's even colour differs from the backdrop's, but in two rows the one goes over into the other gently.
TEST(GrowPlate, DoesNotPassThroughANarrowGap) {
    std::vector<Image<Rgba8>> photos(6, Image<Rgba8>(kPlateWidth, kPlateHeight));
    for (Image<Rgba8>& photo : photos) {
        for (int y = 0; y < kPlateHeight; ++y) {
            for (int x = 0; x < kPlateWidth; ++x) {
                const bool gap = y == 23 || y == 24;
                const int code = gap ? 120 + std::clamp(3 * (x - 30), 0, 40) : x < 37 ? 120 : 160;
                const auto c = static_cast<std::uint8_t>(code);
                photo(x, y) = {c, c, c, 255};
            }
        }
    }
    const EvenedSamples samples(photos);
    const GrownCleanPlate plate = grown(samples, photos[0], seeds(false));
    EXPECT_NE(plate.witnesses(30, 10), 0U);
    EXPECT_EQ(plate.witnesses(60, 10), 0U);
    EXPECT_EQ(plate.witnesses(60, 24), 0U);
}

// A backdrop that gets lighter from left to right, four times in all by more than neighbours may differ.
TEST(GrowPlate, StaysNearAGuessIfAsked) {
    std::vector<Image<Rgba8>> photos(6, Image<Rgba8>(kPlateWidth, kPlateHeight));
    for (Image<Rgba8>& photo : photos) {
        for (int y = 0; y < kPlateHeight; ++y) {
            for (int x = 0; x < kPlateWidth; ++x) {
                const auto c = static_cast<std::uint8_t>(100 + x);
                photo(x, y) = {c, c, c, 255};
            }
        }
    }
    const EvenedSamples samples(photos);
    Image<Rgba8> guess = photos[0];
    for (int y = 0; y < kPlateHeight; ++y) {
        for (int x = kSeedColumns; x < kPlateWidth; ++x) guess(x, y) = {110, 110, 110, 255};
    }
    const GrownCleanPlate free = grown(samples, guess, seeds(false));
    EXPECT_NE(free.witnesses(70, 24), 0U);
    GrownCleanPlate near;
    grow_plate(samples, guess, seeds(false), Image<std::uint8_t>(kPlateWidth, kPlateHeight), near, Growth::kNearGuess);
    EXPECT_NE(near.witnesses(22, 24), 0U);
    EXPECT_EQ(near.witnesses(40, 24), 0U);
}

// A picture on the wall. The post stands on the axis, and bars pass in front of it.
TEST(GrowAcrossEdges, EntersWhatHangsBehindAndNotWhatLooksTheSameFromAllSides) {
    std::vector<Image<Rgba8>> photos = bars_and_a_post();
    constexpr Rgba8 kOnTheWall{30, 60, 200, 255};
    constexpr Rgba8 kPost{60, 150, 60, 255};
    for (std::size_t i = 0; i < photos.size(); ++i) {
        const int bar = 16 + 4 * static_cast<int>(i);
        for (int y = 10; y < kPlateHeight; ++y) {
            for (int x = 36; x < 44; ++x) photos[i](x, y) = x >= bar && x < bar + 6 ? kObject : kPost;
        }
        for (int y = 12; y < 34; ++y) {
            for (int x = 20; x < 32; ++x) {
                if (photos[i](x, y) != kObject) photos[i](x, y) = kOnTheWall;
            }
        }
    }
    const EvenedSamples samples(photos);
    const Image<std::uint8_t> nothing(kPlateWidth, kPlateHeight);
    GrownCleanPlate plate = grown(samples, photos[0], seeds());
    EXPECT_EQ(plate.witnesses(26, 23), 0U) << "growth alone stops at its edge";
    const StillPicture still = agree_over_time(samples);
    grow_across_edges(samples, nothing, RevolutionRows(still, nothing, 40), plate);
    EXPECT_NE(plate.witnesses(26, 23), 0U);
    EXPECT_NEAR(sharp_colours(samples, plate)(26, 23).b, kOnTheWall.b, 2);
    EXPECT_EQ(plate.witnesses(40, 24), 0U) << "the post";

    GrownCleanPlate barred = grown(samples, photos[0], seeds());
    grow_across_edges(samples, Image<std::uint8_t>(kPlateWidth, kPlateHeight, 255), RevolutionRows(still, nothing, 40),
                      barred);
    EXPECT_EQ(barred.witnesses(26, 23), 0U);

    GrownCleanPlate elsewhere = grown(samples, photos[0], seeds());
    grow_across_edges(samples, nothing, RevolutionRows(still, nothing, 20), elsewhere);
    EXPECT_NE(elsewhere.witnesses(40, 24), 0U) << "a post beside the axis is none of the object";
}

TEST(ConfirmPlate, NeedsPatchesInThreePictures) {
    std::vector<Image<Rgba8>> photos(5, Image<Rgba8>(kPlateWidth, kPlateHeight, kObject));
    const Rgba8 behind{100, 110, 120, 255};
    for (std::size_t i = 0; i < photos.size(); ++i) {
        for (int y = 10; y < 20; ++y) {
            for (int x = 10; x < 20; ++x) {
                if (i < 3) photos[i](x, y) = behind;
                if (i < 2) photos[i](x + 30, y) = behind;
            }
        }
        for (int x = 0; x < kPlateWidth; ++x) photos[i](x, 40) = behind;  // no patch, a line
    }
    const EvenedSamples samples(photos);
    const Image<Rgba8> guess(kPlateWidth, kPlateHeight, behind);
    Image<std::uint8_t> asked(kPlateWidth, kPlateHeight, 255);
    asked(16, 14) = 0;
    const Image<std::uint8_t> confirmed = confirm_plate(samples, guess, asked);
    EXPECT_EQ(confirmed(14, 14), 255);
    EXPECT_EQ(confirmed(16, 14), 0) << "not asked for";
    EXPECT_EQ(confirmed(44, 14), 0) << "two pictures only";
    EXPECT_EQ(confirmed(60, 40), 0);
    EXPECT_EQ(confirmed(60, 30), 0);
}

}  // namespace
}  // namespace rs::capture
