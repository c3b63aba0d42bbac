// White objects before a white of one colour, as shops retouch their pictures.

#include "capture/photos/matte/cut_out.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/capture/photos/backdrop_behind.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kBoxes_width = 240, kBoxes_height = 160, kBoxViews = 12;

// A white box that swings to and fro: a few codes darker than the backdrop, lighter towards its top, with a black wheel
// below and a black ring above, through which one sees.
struct WhiteBox {
    double centre_x;
    explicit WhiteBox(int view) : centre_x(120 + 24 * std::sin(2 * kPi * view / kBoxViews)) {}

    [[nodiscard]] bool in_body(int x, int y) const { return std::abs(x - centre_x) < 45 && y >= 50 && y < 120; }
    [[nodiscard]] bool in_wheel(int x, int y) const { return std::hypot(x - centre_x, y - 120) < 11; }
    [[nodiscard]] bool in_ring(int x, int y) const {
        const double r = std::hypot(x - centre_x, y - 38);
        return r >= 8 && r < 13;
    }
    [[nodiscard]] bool in_loop(int x, int y) const { return std::hypot(x - centre_x, y - 38) < 6; }
    [[nodiscard]] bool in_object(int x, int y) const { return in_body(x, y) || in_wheel(x, y) || in_ring(x, y); }
};

// Without its black parts the box is all that is to be seen.
Image<Rgba8> photo_of(const WhiteBox& box, bool black_parts) {
    Image<Rgba8> photo(kBoxes_width, kBoxes_height, Rgba8{255, 255, 255, 255});
    for (int y = 0; y < kBoxes_height; ++y) {
        for (int x = 0; x < kBoxes_width; ++x) {
            if (box.in_body(x, y)) {
                const auto code = static_cast<std::uint8_t>(black_parts ? 240 - (y - 50) / 4 : 230 - (y - 50) / 2);
                photo(x, y) = {code, code, code, 255};
            }
            if (black_parts && (box.in_wheel(x, y) || box.in_ring(x, y))) photo(x, y) = {20, 20, 22, 255};
        }
    }
    return photo;
}

std::vector<Image<Rgba8>> photos_of_turn(bool black_parts) {
    std::vector<Image<Rgba8>> photos;
    for (int view = 0; view < kBoxViews; ++view) photos.push_back(photo_of(WhiteBox(view), black_parts));
    return photos;
}

Backdrop backdrop_of_boxes(const std::vector<Image<Rgba8>>& photos) {
    Result<Backdrop> backdrop = test::backdrop_behind(photos);
    EXPECT_TRUE(backdrop.ok()) << backdrop.error().message;
    return backdrop ? *std::move(backdrop) : Backdrop{};
}

struct BoxErrors {
    int lost = 0, loop_closed = 0, added = 0;  // px
};

BoxErrors errors_of(const Image<Rgba8>& cut, const WhiteBox& box, bool black_parts) {
    BoxErrors errors;
    for (int y = 0; y < kBoxes_height; ++y) {
        for (int x = 0; x < kBoxes_width; ++x) {
            const bool object = black_parts ? box.in_object(x, y) : box.in_body(x, y);
            const bool solid = cut(x, y).a >= 128;
            errors.lost += object && !solid ? 1 : 0;
            errors.added += !object && solid ? 1 : 0;
            errors.loop_closed += black_parts && box.in_loop(x, y) && solid ? 1 : 0;
        }
    }
    return errors;
}

TEST(CutOutBeforeWhite, KeepsAWhiteBodyAndTheLoopBesideIt) {
    const std::vector<Image<Rgba8>> photos = photos_of_turn(true);
    const Backdrop backdrop = backdrop_of_boxes(photos);
    ASSERT_EQ(backdrop.flat_white, (Rgba8{255, 255, 255, 255}));
    Backdrop unknown = backdrop;
    unknown.flat_white.reset();
    const ObjectCutter cutter(backdrop, kBoxes_width, kBoxes_height), without(unknown, kBoxes_width, kBoxes_height);
    for (const int view : {0, 3, 7}) {
        SCOPED_TRACE(view);
        const WhiteBox box(view);
        const auto i = static_cast<std::size_t>(view);
        const BoxErrors errors = errors_of(cutter.cut(photos[i]), box, true);
        EXPECT_LE(errors.lost, 60) << "of 7000";
        EXPECT_LE(errors.added, 60);
        EXPECT_EQ(errors.loop_closed, 0);
        EXPECT_GT(errors_of(without.cut(photos[i]), box, true).lost, 3000) << "what is not known to be flat has noise";
    }
}

// Nothing of it is certain to be no shadow: better that than no object at all.
TEST(CutOutBeforeWhite, KeepsABodyWithoutADarkPart) {
    const std::vector<Image<Rgba8>> photos = photos_of_turn(false);
    const ObjectCutter cutter(backdrop_of_boxes(photos), kBoxes_width, kBoxes_height);
    for (const int view : {0, 3, 7}) {
        SCOPED_TRACE(view);
        const BoxErrors errors = errors_of(cutter.cut(photos[static_cast<std::size_t>(view)]), WhiteBox(view), false);
        EXPECT_LE(errors.lost, 60) << "of 6300";
        EXPECT_LE(errors.added, 60);
    }
}

TEST(CutOutBeforeWhite, AShopsMarkIsNoObject) {
    std::vector<Image<Rgba8>> photos = photos_of_turn(true);
    const auto in_mark = [](int x, int y) { return x >= 10 && x < 60 && y >= 140 && y < 150; };
    for (Image<Rgba8>& photo : photos) {
        for (int y = 0; y < kBoxes_height; ++y) {
            for (int x = 0; x < kBoxes_width; ++x) {
                if (in_mark(x, y)) photo(x, y) = {120, 120, 120, 255};
            }
        }
    }
    const Backdrop backdrop = backdrop_of_boxes(photos);
    ASSERT_TRUE(backdrop.flat_white.has_value());
    const BoxErrors errors =
        errors_of(ObjectCutter(backdrop, kBoxes_width, kBoxes_height).cut(photos[3]), WhiteBox(3), true);
    EXPECT_LE(errors.lost, 60);
    EXPECT_LE(errors.added, 60) << "of a mark of 500";
}

TEST(FlatWhite, IsNoneWhereThereIsNoiseOrExposuresDiffer) {
    std::mt19937 random(7);
    std::vector<Image<Rgba8>> noisy = photos_of_turn(true), changing = noisy, grey = noisy;
    for (int view = 0; view < kBoxViews; ++view) {
        const auto i = static_cast<std::size_t>(view);
        for (int y = 0; y < kBoxes_height; ++y) {
            for (int x = 0; x < kBoxes_width; ++x) {
                if (WhiteBox(view).in_object(x, y)) continue;
                const auto code = static_cast<std::uint8_t>(246 + random() % 9);
                const auto level = static_cast<std::uint8_t>(view % 2 == 0 ? 255 : 250);
                noisy[i](x, y) = {code, code, code, 255};
                changing[i](x, y) = {level, level, level, 255};
                grey[i](x, y) = {245, 246, 244, 255};
            }
        }
    }
    EXPECT_FALSE(backdrop_of_boxes(noisy).flat_white.has_value());
    EXPECT_FALSE(backdrop_of_boxes(changing).flat_white.has_value());
    EXPECT_EQ(backdrop_of_boxes(grey).flat_white, (Rgba8{245, 246, 244, 255})) << "other flat whites are as good";
}

}  // namespace
}  // namespace rs::capture
