// Dark parts of objects before a black background: noisy, even within two codes, exactly black.

#include "capture/photos/segmentation/background_model_segmenter.hpp"
#include "tests/capture/photos/segment_photo.hpp"
#include "tests/capture/photos/turn_of_images.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace rs::capture {
namespace {

// A black strap hangs below the disc in every photo. Before an even black it is segmented whole, before an exact black
// also if it is only four codes lighter; before a black with as much noise it cannot be detected.
TEST(CutOutBeforeBlack, KeepsABlackStrapUnlessTheBackgroundIsNoisy) {
    struct Case {
        BlackBackground black;
        int strap_code;
        unsigned codes;  // number of codes in the background
    };
    test::DrawnTurn turn;
    turn.backdrop = {0, 0, 0, 255};
    std::mt19937 random(3);
    for (const Case& drawn : {Case{BlackBackground::kExact, 4, 1}, Case{BlackBackground::kUniform, 7, 2},
                              Case{BlackBackground::kUnknownOrNoisy, 7, 14}}) {
        SCOPED_TRACE(drawn.codes);
        std::vector<Image<Rgba8>> photos = test::draw_photos(turn);
        for (Image<Rgba8>& photo : photos) {
            for (int y = 0; y < turn.height; ++y) {
                for (int x = 0; x < turn.width; ++x) {
                    const bool strap = x >= 70 && x < 96 && y >= 90 && y < 112;
                    Rgba8& pixel = photo(x, y);
                    if (pixel != turn.backdrop) continue;
                    const bool noisy = drawn.black == BlackBackground::kUnknownOrNoisy;
                    const auto code = static_cast<std::uint8_t>(
                        strap && !noisy ? static_cast<unsigned>(drawn.strap_code) : random() % drawn.codes);
                    pixel = {code, code, code, 255};
                }
            }
        }
        const Result<BackgroundModel> backdrop = test::backdrop_behind(photos);
        ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
        EXPECT_EQ(backdrop->black, drawn.black);
        const Image<Rgba8> cut =
            test::segment_photo(BackgroundModelSegmenter(*backdrop, turn.width, turn.height), photos[2]);
        int strap_pixels = 0;
        int elsewhere = 0;
        for (int y = 0; y < turn.height; ++y) {
            for (int x = 0; x < turn.width; ++x) {
                if (cut(x, y).a < 128 || std::hypot(x - 116, y - 60) < 24) continue;
                const bool strap = x >= 69 && x < 97 && y >= 89 && y < 113;
                ++(strap ? strap_pixels : elsewhere);
            }
        }
        EXPECT_EQ(elsewhere, 0);
        if (drawn.black == BlackBackground::kUnknownOrNoisy) {
            EXPECT_EQ(strap_pixels, 0);
        } else {
            EXPECT_GT(strap_pixels, 500) << "of 572";
        }
    }
}

// Before an exact black: a dark body fades to code 0 in its inside, which the graph cut fills, and has a hole of the
// same size with a rim, which stays open. Both are larger than Score::max_island of other backgrounds.
TEST(CutOutBeforeBlack, FillsFadingInsidesAndKeepsHolesWithARim) {
    constexpr double kBlackRadius_px = 7, kFade_px = 12;
    test::DrawnTurn turn;
    turn.backdrop = {0, 0, 0, 255};
    const Result<BackgroundModel> backdrop = test::backdrop_behind(test::draw_photos(turn));
    ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
    ASSERT_EQ(backdrop->black, BlackBackground::kExact);

    Image<Rgba8> photo(turn.width, turn.height, turn.backdrop);
    for (int y = 20; y < 100; ++y) {
        for (int x = 20; x < 140; ++x) {
            const double faded = (std::hypot(x - 50, y - 60) - kBlackRadius_px) / kFade_px;
            const auto code = static_cast<std::uint8_t>(std::lround(24 * std::clamp(faded, 0.0, 1.0)));
            photo(x, y) = {code, code, code, 255};
            if (std::hypot(x - 110, y - 60) < kBlackRadius_px) photo(x, y) = turn.backdrop;
        }
    }
    const Image<Rgba8> cut = test::segment_photo(BackgroundModelSegmenter(*backdrop, turn.width, turn.height), photo);
    int lost = 0, closed = 0;
    for (int y = 0; y < turn.height; ++y) {
        for (int x = 0; x < turn.width; ++x) {
            if (std::hypot(x - 50, y - 60) < kBlackRadius_px + kFade_px && cut(x, y).a < 255) ++lost;
            if (std::hypot(x - 110, y - 60) < kBlackRadius_px - 2 && cut(x, y).a > 0) ++closed;
        }
    }
    EXPECT_EQ(lost, 0) << "where the body fades";
    EXPECT_EQ(closed, 0) << "in the hole";
    EXPECT_EQ(cut(80, 30).a, 255);
    EXPECT_EQ(cut(5, 5).a, 0);
}

}  // namespace
}  // namespace rs::capture
