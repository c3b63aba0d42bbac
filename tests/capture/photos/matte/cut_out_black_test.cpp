// Dark parts of objects before a black backdrop: noisy, even, exact.

#include "capture/photos/matte/cut_out.hpp"
#include "tests/capture/photos/backdrop_behind.hpp"
#include "tests/capture/photos/turn_of_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace rs::capture {
namespace {

// A black strap hangs below the disc's place in every picture. Before an even black it is cut out whole, before an
// exact black also where it is only four codes lighter; where the black itself is as noisy, nobody can tell.
TEST(CutOutBeforeBlack, KeepsABlackStrapBeforeAnEvenBlack) {
    struct Case {
        BlackGround black;
        int strap_code;
        unsigned codes;  // that the backdrop has
    };
    test::DrawnTurn turn;
    turn.backdrop = {0, 0, 0, 255};
    std::mt19937 random(3);
    for (const Case& drawn :
         {Case{BlackGround::kExact, 4, 1}, Case{BlackGround::kEven, 7, 2}, Case{BlackGround::kUnknownOrNoisy, 7, 14}}) {
        SCOPED_TRACE(drawn.codes);
        std::vector<Image<Rgba8>> photos = test::draw_photos(turn);
        for (Image<Rgba8>& photo : photos) {
            for (int y = 0; y < turn.height; ++y) {
                for (int x = 0; x < turn.width; ++x) {
                    const bool strap = x >= 70 && x < 96 && y >= 90 && y < 112;
                    Rgba8& pixel = photo(x, y);
                    if (pixel != turn.backdrop) continue;
                    const bool noisy = drawn.black == BlackGround::kUnknownOrNoisy;
                    const auto code = static_cast<std::uint8_t>(
                        strap && !noisy ? static_cast<unsigned>(drawn.strap_code) : random() % drawn.codes);
                    pixel = {code, code, code, 255};
                }
            }
        }
        const Result<Backdrop> backdrop = test::backdrop_behind(photos);
        ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
        EXPECT_EQ(backdrop->black, drawn.black);
        const Image<Rgba8> cut = ObjectCutter(*backdrop, turn.width, turn.height).cut(photos[2]);
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
        if (drawn.black == BlackGround::kUnknownOrNoisy) {
            EXPECT_EQ(strap_pixels, 0);
        } else {
            EXPECT_GT(strap_pixels, 500) << "of 572";
        }
    }
}

// Before an exact black: a dark body fades to 0 within itself, which the cut closes, and has a hole of the same size
// with a rim, through which one sees. Both are larger than the islands that elsewhere may be the object's.
TEST(CutOutBeforeBlack, ClosesWhatFadesToAnExactBlackAndKeepsAHoleWithARim) {
    constexpr double kBlackRadius_px = 7, kFade_px = 12;
    test::DrawnTurn turn;
    turn.backdrop = {0, 0, 0, 255};
    const Result<Backdrop> backdrop = test::backdrop_behind(test::draw_photos(turn));
    ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
    ASSERT_EQ(backdrop->black, BlackGround::kExact);

    Image<Rgba8> photo(turn.width, turn.height, turn.backdrop);
    for (int y = 20; y < 100; ++y) {
        for (int x = 20; x < 140; ++x) {
            const double faded = (std::hypot(x - 50, y - 60) - kBlackRadius_px) / kFade_px;
            const auto code = static_cast<std::uint8_t>(std::lround(24 * std::clamp(faded, 0.0, 1.0)));
            photo(x, y) = {code, code, code, 255};
            if (std::hypot(x - 110, y - 60) < kBlackRadius_px) photo(x, y) = turn.backdrop;
        }
    }
    const Image<Rgba8> cut = ObjectCutter(*backdrop, turn.width, turn.height).cut(photo);
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
