// White objects before a uniform white, as in retouched product photos, and grey ones before a uniform grey.

#include "capture/photos/segmentation/background_model_segmenter.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/capture/photos/segment_photo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kBoxes_width = 240, kBoxes_height = 160, kBoxViews = 12;

// A grey box that swings to and fro. It differs from the background by a few codes, less towards its top, and has a
// black wheel below and a black ring above, with an open loop.
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

// sRGB codes.
struct BoxColours {
    int background = 255;
    int top_offset = -15, bottom_offset = -33;  // of the body from the background
    bool black_parts = true;                    // wheel and ring
};

Image<Rgba8> photo_of(const GreyBox& box, const BoxColours& colours) {
    const auto grey = [](int code) {
        const auto one = static_cast<std::uint8_t>(code);
        return Rgba8{one, one, one, 255};
    };
    Image<Rgba8> photo(kBoxes_width, kBoxes_height, grey(colours.background));
    for (int y = 0; y < kBoxes_height; ++y) {
        for (int x = 0; x < kBoxes_width; ++x) {
            const int offset = colours.top_offset + (colours.bottom_offset - colours.top_offset) * (y - 50) / 70;
            if (box.in_body(x, y)) photo(x, y) = grey(colours.background + offset);
            if (colours.black_parts && (box.in_wheel(x, y) || box.in_ring(x, y))) photo(x, y) = {20, 20, 22, 255};
        }
    }
    return photo;
}

std::vector<Image<Rgba8>> photos_of_turn(const BoxColours& colours) {
    std::vector<Image<Rgba8>> photos;
    for (int view = 0; view < kBoxViews; ++view) photos.push_back(photo_of(GreyBox(view), colours));
    return photos;
}

BackgroundModel estimate_box_background(const std::vector<Image<Rgba8>>& photos) {
    Result<BackgroundModel> background = test::backdrop_behind(photos);
    EXPECT_TRUE(background.ok()) << background.error().message;
    return background ? *std::move(background) : BackgroundModel{};
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

TEST(CutOutBeforeGrey, KeepsABodyOfSimilarGreyAndTheLoop) {
    for (const BoxColours& colours : {BoxColours{}, BoxColours{200}, BoxColours{200, 16, 30}}) {
        SCOPED_TRACE(colours.background + colours.top_offset);
        const std::vector<Image<Rgba8>> photos = photos_of_turn(colours);
        const BackgroundModel found = estimate_box_background(photos);
        ASSERT_TRUE(found.flat_grey.has_value());
        EXPECT_EQ(found.flat_grey->g, colours.background);
        ASSERT_FALSE(found.gradient.empty());
        const BackgroundModelSegmenter studio(found, kBoxes_width, kBoxes_height);
        BackgroundModel background = found;  // no fitted gradient, and the body is part of the plate
        background.gradient = {};
        background.shadow_free = {};
        background.plate = photo_of(GreyBox(0), {colours.background, colours.top_offset, colours.bottom_offset, false});
        BackgroundModel unknown = background;  // nor is the grey known to be flat
        unknown.flat_grey.reset();
        unknown.always_visible = {};
        const BackgroundModelSegmenter cutter(background, kBoxes_width, kBoxes_height),
            without(unknown, kBoxes_width, kBoxes_height);
        for (const int view : {0, 3, 7}) {
            SCOPED_TRACE(view);
            const GreyBox box(view);
            const auto i = static_cast<std::size_t>(view);
            const BoxErrors errors = errors_of(test::segment_photo(cutter, photos[i]), box, true);
            EXPECT_LE(errors.lost, 60) << "of 7000";
            EXPECT_LE(errors.added, 60);
            EXPECT_EQ(errors.loop_closed, 0);
            const BoxErrors in_studio = errors_of(test::segment_photo(studio, photos[i]), box, true);
            EXPECT_LE(in_studio.lost, 60);
            EXPECT_LE(in_studio.added, 60);
            EXPECT_EQ(in_studio.loop_closed, 0);
            EXPECT_GT(errors_of(test::segment_photo(without, photos[i]), box, true).lost, 3000)
                << "without flat_grey, noise is assumed";
        }
    }
}

// Every pixel of it could be a shadow; it is segmented nevertheless, because the mask would be empty.
TEST(CutOutBeforeGrey, KeepsABodyWithoutADarkPart) {
    const std::vector<Image<Rgba8>> photos = photos_of_turn({255, -25, -60, false});
    const BackgroundModelSegmenter cutter(estimate_box_background(photos), kBoxes_width, kBoxes_height);
    for (const int view : {0, 3, 7}) {
        SCOPED_TRACE(view);
        const BoxErrors errors =
            errors_of(test::segment_photo(cutter, photos[static_cast<std::size_t>(view)]), GreyBox(view), false);
        EXPECT_LE(errors.lost, 60) << "of 6300";
        EXPECT_LE(errors.added, 60);
    }
}

TEST(CutOutBeforeGrey, IgnoresAShopsLogo) {
    std::vector<Image<Rgba8>> photos = photos_of_turn({});
    const auto in_logo = [](int x, int y) { return x >= 10 && x < 60 && y >= 140 && y < 150; };
    for (Image<Rgba8>& photo : photos) {
        for (int y = 0; y < kBoxes_height; ++y) {
            for (int x = 0; x < kBoxes_width; ++x) {
                if (in_logo(x, y)) photo(x, y) = {20, 20, 20, 255};
            }
        }
    }
    for (const int sample_side_px : {kBoxes_width, kBoxes_width / 2}) {
        SCOPED_TRACE(sample_side_px);
        const Result<BackgroundModel> background = test::backdrop_behind(photos, sample_side_px);
        ASSERT_TRUE(background.ok());
        ASSERT_TRUE(background->flat_grey.has_value());
        const Image<Rgba8> cut =
            test::segment_photo(BackgroundModelSegmenter(*background, kBoxes_width, kBoxes_height), photos[3]);
        const BoxErrors errors = errors_of(cut, GreyBox(3), true);
        EXPECT_LE(errors.lost, 60);
        EXPECT_LE(errors.added, 60) << "of a logo of 500";
    }
}

// JPEG compression of a uniform colour leaves deviations of one code.
TEST(CutOutBeforeGrey, IgnoresDeviationsOfOneCode) {
    std::vector<Image<Rgba8>> photos = photos_of_turn({});
    for (Image<Rgba8>& photo : photos) {
        for (int y = 0; y < kBoxes_height; ++y) {
            for (int x = 0; x < kBoxes_width; ++x) {
                if (photo(x, y).b == 255) photo(x, y) = {255, static_cast<std::uint8_t>(255 - (x + y) % 2), 255, 255};
            }
        }
    }
    const BackgroundModel background = estimate_box_background(photos);
    ASSERT_TRUE(background.flat_grey.has_value());
    const BackgroundModelSegmenter cutter(background, kBoxes_width, kBoxes_height);
    const BoxErrors errors = errors_of(test::segment_photo(cutter, photos[3]), GreyBox(3), true);
    EXPECT_LE(errors.lost, 60);
    EXPECT_LE(errors.added, 60);
    EXPECT_EQ(errors.loop_closed, 0);
}

// A photo of another exposure has another grey everywhere.
TEST(CutOutBeforeGrey, UsesTheGeneralModelForAnotherExposure) {
    std::vector<Image<Rgba8>> photos = photos_of_turn({});
    for (std::size_t i = 0; i < photos.size(); i += 3) photos[i] = photo_of(GreyBox(static_cast<int>(i)), {210});
    const BackgroundModel background = estimate_box_background(photos);
    ASSERT_EQ(background.flat_grey, (Rgba8{255, 255, 255, 255}));
    BackgroundModel unknown = background;
    unknown.flat_grey.reset();
    const BackgroundModelSegmenter cutter(background, kBoxes_width, kBoxes_height),
        without(unknown, kBoxes_width, kBoxes_height);
    EXPECT_EQ(test::segment_photo(cutter, photos[3]), test::segment_photo(without, photos[3]));
    EXPECT_LE(errors_of(test::segment_photo(cutter, photos[4]), GreyBox(4), true).lost, 60);
}

TEST(FlatGrey, IsNotDetectedWithNoiseOrColourOrATable) {
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
    EXPECT_FALSE(estimate_box_background(noisy).flat_grey.has_value());
    EXPECT_FALSE(estimate_box_background(table).flat_grey.has_value());
    EXPECT_FALSE(estimate_box_background(blue).flat_grey.has_value());
}

}  // namespace
}  // namespace rs::capture
