#include "capture/photos/background/plate_propagation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kPlateWidth = 80;
constexpr int kPlateHeight = 48;
constexpr int kSeedColumns = 12;  // at either side

Rgba8 background_at(int x, int y) {
    const auto code = static_cast<std::uint8_t>(110 + x / 4 + y / 4);
    return {code, static_cast<std::uint8_t>(code - 20), 90, 255};
}

constexpr Rgba8 kObject{210, 40, 60, 255};
constexpr BackgroundParameters::Propagation kPropagationParameters{};

// Frames with a bar of the object at a different place in each, and a post always in the middle.
std::vector<Image<Rgba8>> bars_and_a_post() {
    constexpr int kFrames = 12;
    std::vector<Image<Rgba8>> frames;
    for (int i = 0; i < kFrames; ++i) {
        Image<Rgba8> frame(kPlateWidth, kPlateHeight);
        const int bar = 16 + 4 * i;
        for (int y = 0; y < kPlateHeight; ++y) {
            for (int x = 0; x < kPlateWidth; ++x) {
                const bool is_object = (x >= bar && x < bar + 6) || (x >= 36 && x < 44 && y >= 10);
                frame(x, y) = is_object ? kObject : background_at(x, y);
            }
        }
        frames.push_back(frame);
    }
    return frames;
}

Image<std::uint8_t> seeds(bool right = true) {
    Image<std::uint8_t> mask(kPlateWidth, kPlateHeight);
    for (int y = 0; y < kPlateHeight; ++y) {
        for (int x = 0; x < kSeedColumns; ++x)
            mask(x, y) = mask(kPlateWidth - 1 - (right ? x : kPlateWidth - 1 - x), y) = 255;
    }
    return mask;
}

PropagatedPlate grown(const ExposureNormalizedFrames& frames, const Image<Rgba8>& guess,
                      const Image<std::uint8_t>& seeds,
                      const Image<std::uint8_t>& barred = Image<std::uint8_t>(kPlateWidth, kPlateHeight)) {
    PropagatedPlate plate;
    propagate_plate(frames, {guess, seeds, barred, Growth::kFree}, kPropagationParameters, plate);
    return plate;
}

TEST(PropagatePlate, GrowsBehindMovingPartsAndStopsAtStaticOnes) {
    const std::vector<Image<Rgba8>> photos = bars_and_a_post();
    const ExposureNormalizedFrames frames(photos);
    const PropagatedPlate plate = grown(frames, photos[0], seeds());
    const Image<Rgba8> colours = undenoised_colours(frames, plate);
    for (int y = 0; y < kPlateHeight; ++y) {
        for (int x = 0; x < kPlateWidth; ++x) {
            const bool post = x >= 36 && x < 44 && y >= 10;
            if (post) {
                ASSERT_EQ(plate.support(x, y), 0U) << x << "," << y;
            } else if (x < 34 || x >= 46) {
                ASSERT_NE(plate.support(x, y), 0U) << x << "," << y;
                ASSERT_NEAR(colours(x, y).r, background_at(x, y).r, 3) << x << "," << y;
            }
        }
    }
    EXPECT_EQ(plate.support(18, 24) & 1U, 0U) << "the first frame has its bar there";
    EXPECT_NE(plate.support(18, 24) & 0x800U, 0U) << "the last frame shows the background";
}

TEST(PropagatePlate, DoesNotEnterBarredPixels) {
    const std::vector<Image<Rgba8>> photos = bars_and_a_post();
    const ExposureNormalizedFrames frames(photos);
    Image<std::uint8_t> barred(kPlateWidth, kPlateHeight);
    for (int y = 20; y < 30; ++y) {
        for (int x = 20; x < 30; ++x) barred(x, y) = 255;
    }
    const PropagatedPlate plate = grown(frames, photos[0], seeds(), barred);
    EXPECT_EQ(plate.support(25, 25), 0U);
    EXPECT_NE(plate.support(25, 15), 0U);
}

// The object's colour differs from the background's, but in two rows there is a smooth transition.
TEST(PropagatePlate, DoesNotPassThroughANarrowGap) {
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
    const ExposureNormalizedFrames frames(photos);
    const PropagatedPlate plate = grown(frames, photos[0], seeds(false));
    EXPECT_NE(plate.support(30, 10), 0U);
    EXPECT_EQ(plate.support(60, 10), 0U);
    EXPECT_EQ(plate.support(60, 24), 0U);
}

// A background gradient from left to right, whose range is many times the tolerance between neighbours.
TEST(PropagatePlate, StaysNearTheGuessOnRequest) {
    std::vector<Image<Rgba8>> photos(6, Image<Rgba8>(kPlateWidth, kPlateHeight));
    for (Image<Rgba8>& photo : photos) {
        for (int y = 0; y < kPlateHeight; ++y) {
            for (int x = 0; x < kPlateWidth; ++x) {
                const auto c = static_cast<std::uint8_t>(100 + x);
                photo(x, y) = {c, c, c, 255};
            }
        }
    }
    const ExposureNormalizedFrames frames(photos);
    Image<Rgba8> guess = photos[0];
    for (int y = 0; y < kPlateHeight; ++y) {
        for (int x = kSeedColumns; x < kPlateWidth; ++x) guess(x, y) = {110, 110, 110, 255};
    }
    const PropagatedPlate free = grown(frames, guess, seeds(false));
    EXPECT_NE(free.support(70, 24), 0U);
    PropagatedPlate near;
    propagate_plate(frames,
                    {.guess = guess,
                     .seeds = seeds(false),
                     .barred = Image<std::uint8_t>(kPlateWidth, kPlateHeight),
                     .growth = Growth::kNearGuess},
                    kPropagationParameters, near);
    EXPECT_NE(near.support(22, 24), 0U);
    EXPECT_EQ(near.support(40, 24), 0U);
}

// Squares of the guessed colour in three and in two frames, and a line in all frames.
TEST(ConfirmPlate, NeedsPatchesInThreeFrames) {
    std::vector<Image<Rgba8>> photos(5, Image<Rgba8>(kPlateWidth, kPlateHeight, kObject));
    const Rgba8 behind{100, 110, 120, 255};
    for (std::size_t i = 0; i < photos.size(); ++i) {
        for (int y = 10; y < 20; ++y) {
            for (int x = 10; x < 20; ++x) {
                if (i < 3) photos[i](x, y) = behind;
                if (i < 2) photos[i](x + 30, y) = behind;
            }
        }
        for (int x = 0; x < kPlateWidth; ++x) photos[i](x, 40) = behind;  // narrower than a patch
    }
    const ExposureNormalizedFrames frames(photos);
    const Image<Rgba8> guess(kPlateWidth, kPlateHeight, behind);
    Image<std::uint8_t> candidates(kPlateWidth, kPlateHeight, 255);
    candidates(16, 14) = 0;
    const Image<std::uint8_t> confirmed = confirm_plate(frames, guess, candidates, kPropagationParameters);
    EXPECT_EQ(confirmed(14, 14), 255);
    EXPECT_EQ(confirmed(16, 14), 0) << "not a candidate";
    EXPECT_EQ(confirmed(44, 14), 0) << "two frames only";
    EXPECT_EQ(confirmed(60, 40), 0);
    EXPECT_EQ(confirmed(60, 30), 0);
}

}  // namespace
}  // namespace rs::capture
