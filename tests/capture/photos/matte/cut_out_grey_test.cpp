// White objects before a white of one colour, as shops retouch their pictures, and grey ones before a grey.

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

// A grey box that swings to and fro: a few codes off the backdrop, less towards its top, with a black wheel below and a
// black ring above, through which one sees.
struct GreyBox {
    double centre_x;
    explicit GreyBox(int view) : centre_x(120 + 24 * std::sin(2 * kPi * view / kBoxViews)) {}

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
struct BoxLook {
    int backdrop = 255;
    int top_off = -15, bottom_off = -33;  // the body from the backdrop, in codes
    bool black_parts = true;
};

Image<Rgba8> photo_of(const GreyBox& box, const BoxLook& look) {
    const auto grey = [](int code) {
        const auto one = static_cast<std::uint8_t>(code);
        return Rgba8{one, one, one, 255};
    };
    Image<Rgba8> photo(kBoxes_width, kBoxes_height, grey(look.backdrop));
    for (int y = 0; y < kBoxes_height; ++y) {
        for (int x = 0; x < kBoxes_width; ++x) {
            const int off = look.top_off + (look.bottom_off - look.top_off) * (y - 50) / 70;
            if (box.in_body(x, y)) photo(x, y) = grey(look.backdrop + off);
            if (look.black_parts && (box.in_wheel(x, y) || box.in_ring(x, y))) photo(x, y) = {20, 20, 22, 255};
        }
    }
    return photo;
}

std::vector<Image<Rgba8>> photos_of_turn(const BoxLook& look) {
    std::vector<Image<Rgba8>> photos;
    for (int view = 0; view < kBoxViews; ++view) photos.push_back(photo_of(GreyBox(view), look));
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

BoxErrors errors_of(const Image<Rgba8>& cut, const GreyBox& box, bool black_parts) {
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

TEST(CutOutBeforeGrey, KeepsABodyOfLikeGreyAndTheLoopBesideIt) {
    for (const BoxLook& look : {BoxLook{}, BoxLook{200}, BoxLook{200, 16, 30}}) {
        SCOPED_TRACE(look.backdrop + look.top_off);
        const std::vector<Image<Rgba8>> photos = photos_of_turn(look);
        const Backdrop found = backdrop_of_boxes(photos);
        ASSERT_TRUE(found.flat_grey.has_value());
        EXPECT_EQ(found.flat_grey->g, look.backdrop);
        ASSERT_FALSE(found.even.empty());
        const ObjectCutter studio(found, kBoxes_width, kBoxes_height);
        Backdrop backdrop = found;  // not known as a studio's, and the body taken for the plate, as one that grows does
        backdrop.even = {};
        backdrop.above_shadows = {};
        backdrop.plate = photo_of(GreyBox(0), {look.backdrop, look.top_off, look.bottom_off, false});
        Backdrop unknown = backdrop;  // nor as flat
        unknown.flat_grey.reset();
        unknown.untouched = {};
        const ObjectCutter cutter(backdrop, kBoxes_width, kBoxes_height), without(unknown, kBoxes_width, kBoxes_height);
        for (const int view : {0, 3, 7}) {
            SCOPED_TRACE(view);
            const GreyBox box(view);
            const auto i = static_cast<std::size_t>(view);
            const BoxErrors errors = errors_of(cutter.cut(photos[i]), box, true);
            EXPECT_LE(errors.lost, 60) << "of 7000";
            EXPECT_LE(errors.added, 60);
            EXPECT_EQ(errors.loop_closed, 0);
            const BoxErrors in_studio = errors_of(studio.cut(photos[i]), box, true);
            EXPECT_LE(in_studio.lost, 60);
            EXPECT_LE(in_studio.added, 60);
            EXPECT_EQ(in_studio.loop_closed, 0);
            EXPECT_GT(errors_of(without.cut(photos[i]), box, true).lost, 3000)
                << "what is not known to be flat has noise";
        }
    }
}

// Nothing of it is certain to be no shadow: better that than no object at all.
TEST(CutOutBeforeGrey, KeepsABodyWithoutADarkPart) {
    const std::vector<Image<Rgba8>> photos = photos_of_turn({255, -25, -60, false});
    const ObjectCutter cutter(backdrop_of_boxes(photos), kBoxes_width, kBoxes_height);
    for (const int view : {0, 3, 7}) {
        SCOPED_TRACE(view);
        const BoxErrors errors = errors_of(cutter.cut(photos[static_cast<std::size_t>(view)]), GreyBox(view), false);
        EXPECT_LE(errors.lost, 60) << "of 6300";
        EXPECT_LE(errors.added, 60);
    }
}

TEST(CutOutBeforeGrey, AShopsMarkIsNoObject) {
    std::vector<Image<Rgba8>> photos = photos_of_turn({});
    const auto in_mark = [](int x, int y) { return x >= 10 && x < 60 && y >= 140 && y < 150; };
    for (Image<Rgba8>& photo : photos) {
        for (int y = 0; y < kBoxes_height; ++y) {
            for (int x = 0; x < kBoxes_width; ++x) {
                if (in_mark(x, y)) photo(x, y) = {20, 20, 20, 255};
            }
        }
    }
    for (const int sample_side_px : {kBoxes_width, kBoxes_width / 2}) {
        SCOPED_TRACE(sample_side_px);
        const Result<Backdrop> backdrop = test::backdrop_behind(photos, sample_side_px);
        ASSERT_TRUE(backdrop.ok());
        ASSERT_TRUE(backdrop->flat_grey.has_value());
        const Image<Rgba8> cut = ObjectCutter(*backdrop, kBoxes_width, kBoxes_height).cut(photos[3]);
        const BoxErrors errors = errors_of(cut, GreyBox(3), true);
        EXPECT_LE(errors.lost, 60);
        EXPECT_LE(errors.added, 60) << "of a mark of 500";
    }
}

// JPEG leaves single codes of colour.
TEST(CutOutBeforeGrey, SingleCodesAreNoObject) {
    std::vector<Image<Rgba8>> photos = photos_of_turn({});
    for (Image<Rgba8>& photo : photos) {
        for (int y = 0; y < kBoxes_height; ++y) {
            for (int x = 0; x < kBoxes_width; ++x) {
                if (photo(x, y).b == 255) photo(x, y) = {255, static_cast<std::uint8_t>(255 - (x + y) % 2), 255, 255};
            }
        }
    }
    const Backdrop backdrop = backdrop_of_boxes(photos);
    ASSERT_TRUE(backdrop.flat_grey.has_value());
    const ObjectCutter cutter(backdrop, kBoxes_width, kBoxes_height);
    const BoxErrors errors = errors_of(cutter.cut(photos[3]), GreyBox(3), true);
    EXPECT_LE(errors.lost, 60);
    EXPECT_LE(errors.added, 60);
    EXPECT_EQ(errors.loop_closed, 0);
}

// A picture that is darker than the others shows another grey, all over.
TEST(CutOutBeforeGrey, APictureOfAnotherExposureIsCutAsBefore) {
    std::vector<Image<Rgba8>> photos = photos_of_turn({});
    for (std::size_t i = 0; i < photos.size(); i += 3) photos[i] = photo_of(GreyBox(static_cast<int>(i)), {210});
    const Backdrop backdrop = backdrop_of_boxes(photos);
    ASSERT_EQ(backdrop.flat_grey, (Rgba8{255, 255, 255, 255}));
    Backdrop unknown = backdrop;
    unknown.flat_grey.reset();
    const ObjectCutter cutter(backdrop, kBoxes_width, kBoxes_height), without(unknown, kBoxes_width, kBoxes_height);
    EXPECT_EQ(cutter.cut(photos[3]), without.cut(photos[3]));
    EXPECT_LE(errors_of(cutter.cut(photos[4]), GreyBox(4), true).lost, 60);
}

TEST(FlatGrey, IsNoneWhereThereIsNoiseOrColourOrATable) {
    std::mt19937 random(7);
    std::vector<Image<Rgba8>> noisy = photos_of_turn({}), table = noisy, blue = noisy;
    for (int view = 0; view < kBoxViews; ++view) {
        const auto i = static_cast<std::size_t>(view);
        for (int y = 0; y < kBoxes_height; ++y) {
            for (int x = 0; x < kBoxes_width; ++x) {
                if (GreyBox(view).in_object(x, y)) continue;
                const auto code = static_cast<std::uint8_t>(246 + random() % 9);
                noisy[i](x, y) = {code, code, code, 255};
                if (y > 110) table[i](x, y) = {235, 235, 235, 255};
                blue[i](x, y) = {60, 80, 200, 255};
            }
        }
    }
    EXPECT_FALSE(backdrop_of_boxes(noisy).flat_grey.has_value());
    EXPECT_FALSE(backdrop_of_boxes(table).flat_grey.has_value());
    EXPECT_FALSE(backdrop_of_boxes(blue).flat_grey.has_value());
}

}  // namespace
}  // namespace rs::capture
