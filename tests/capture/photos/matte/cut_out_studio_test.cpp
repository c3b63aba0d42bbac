// White and grey objects in a studio, whose grey goes over from light to dark: their sides look as a shadow on it
// would.

#include "capture/photos/matte/cut_out.hpp"
#include "capture/photos/matte/enclosed_parts.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/capture/photos/backdrop_behind.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kStudio_width = 240, kStudio_height = 160, kStudioViews = 12;

float studio_light(int x, int y) {
    const double u = (x - 120) / 120.0, v = (y - 80) / 80.0;
    return linear_from_srgb(static_cast<float>((210 - 14 * v - 10 * u * u - 6 * v * v) / 255));
}

// A box that swings to and fro, with a black wheel below and a black ring above, through which one sees. Its shadow
// lies on the ground before it, darkest at the box.
struct ShadedBox {
    double centre_x;
    explicit ShadedBox(int view) : centre_x(120 + 24 * std::sin(2 * kPi * view / kStudioViews)) {}

    [[nodiscard]] bool in_body(int x, int y) const { return std::abs(x - centre_x) < 45 && y >= 50 && y < 110; }
    [[nodiscard]] bool in_wheel(int x, int y) const { return std::hypot(x - centre_x, y - 110) < 11; }
    [[nodiscard]] bool in_ring(int x, int y) const {
        const double r = std::hypot(x - centre_x, y - 34);
        return r >= 10 && r < 16;
    }
    [[nodiscard]] bool in_loop(int x, int y) const { return std::hypot(x - centre_x, y - 34) < 8; }
    [[nodiscard]] double shadow(int x, int y) const {
        const double across = (x - centre_x) / 50, down = (y - 112) / 16.0;
        return y < 105 ? 0 : 0.25 * std::exp(-across * across - down * down);
    }
};

// The shares are what the body has of the light of the backdrop, from its top to its bottom.
Image<Rgba8> photo_of(const ShadedBox& box, int view, double top_share, double bottom_share) {
    std::minstd_rand random(static_cast<unsigned>(view) + 1);
    std::uniform_int_distribution<int> noise(-1, 1);
    Image<Rgba8> photo(kStudio_width, kStudio_height);
    for (int y = 0; y < kStudio_height; ++y) {
        for (int x = 0; x < kStudio_width; ++x) {
            double share = 1 - box.shadow(x, y);
            if (box.in_body(x, y)) share = top_share + (bottom_share - top_share) * (y - 50) / 60;
            if (box.in_wheel(x, y) || box.in_ring(x, y)) share = 0.01;
            const int code = srgb8_from_linear(static_cast<float>(share) * studio_light(x, y)) + noise(random);
            const auto grey = static_cast<std::uint8_t>(std::clamp(code, 0, 255));
            photo(x, y) = {grey, grey, grey, 255};
        }
    }
    return photo;
}

std::vector<Image<Rgba8>> photos_of_turn(double top_share, double bottom_share) {
    std::vector<Image<Rgba8>> photos;
    for (int view = 0; view < kStudioViews; ++view) {
        photos.push_back(photo_of(ShadedBox(view), view, top_share, bottom_share));
    }
    return photos;
}

struct StudioErrors {
    int body_lost = 0, loop_closed = 0, added = 0;  // px
};

StudioErrors errors_of(const Image<Rgba8>& cut, const ShadedBox& box) {
    StudioErrors errors;
    for (int y = 0; y < kStudio_height; ++y) {
        for (int x = 0; x < kStudio_width; ++x) {
            const bool solid = cut(x, y).a >= 128;
            const bool object = box.in_body(x, y) || box.in_wheel(x, y) || box.in_ring(x, y);
            errors.body_lost += box.in_body(x, y) && !solid ? 1 : 0;
            errors.loop_closed += box.in_loop(x, y) && solid ? 1 : 0;
            errors.added += !object && !box.in_loop(x, y) && solid ? 1 : 0;
        }
    }
    return errors;
}

TEST(CutOutInAStudio, KeepsSidesThatAShadowCouldExplainAndNoShadow) {
    for (const auto& [top, bottom] : {std::pair{0.9, 0.45}, {0.8, 0.55}, {0.6, 0.5}}) {
        SCOPED_TRACE(top);
        const std::vector<Image<Rgba8>> photos = photos_of_turn(top, bottom);
        const Result<Backdrop> backdrop = test::backdrop_behind(photos);
        ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
        const ObjectCutter cutter(*backdrop, kStudio_width, kStudio_height);
        for (const int view : {0, 3, 7}) {
            SCOPED_TRACE(view);
            const StudioErrors errors = errors_of(cutter.cut(photos[static_cast<std::size_t>(view)]), ShadedBox(view));
            EXPECT_LE(errors.body_lost, 60) << "of 5400";
            EXPECT_LE(errors.added, 150);
            EXPECT_LE(errors.loop_closed, 10) << "of 197";
        }
    }
}

// The core of a shadow lies where it lies in most pictures, so that a plate of what is seen the most holds it; where
// the floor is lit in another picture, it is no object for that.
TEST(CutOutInAStudio, TheFloorThatIsLitInSomePicturesIsNoObject) {
    constexpr int kTimes = 2, kViews = 36, kWidth = kTimes * kStudio_width, kHeight = kTimes * kStudio_height;
    // Broad from the side and narrow from its front, as a shoe; in pixels of the studio.
    const auto reach = [](int view) { return 14 + 46 * std::abs(std::cos(2 * kPi * view / kViews)); };
    const auto ground = [](int view) { return 110 + 4 * std::abs(std::sin(2 * kPi * view / kViews)); };
    const auto in_object = [&](int view, double x, double y) {
        return std::abs(x - 120) < reach(view) && y >= 40 && y < ground(view);
    };
    // Of wall and floor what the shadow leaves.
    const auto light_at = [&](int view, double x, double y) {
        const double u = (x - 120) / 120, v = (y - 80) / 80;
        const double floor = 1 + 0.07 * std::tanh((y - 96) / 4);
        const double across = (x - 120) / (1.2 * reach(view));
        const double down = (y - ground(view) - 2) / (0.3 * std::max(24.0, reach(view)));
        const double light = linear_from_srgb(static_cast<float>(0.9 * floor * (210 - 14 * v - 10 * u * u) / 255));
        return light * (1 - 0.8 * std::exp(-std::pow(across, 4) - down * down));
    };
    std::vector<Image<Rgba8>> photos;
    for (int view = 0; view < kViews; ++view) {
        std::minstd_rand random(static_cast<unsigned>(view) + 1);
        std::uniform_int_distribution<int> noise(-1, 1);
        Image<Rgba8>& photo = photos.emplace_back(kWidth, kHeight);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const double u = static_cast<double>(x) / kTimes, v = static_cast<double>(y) / kTimes;
                const std::uint8_t grey = srgb8_from_linear(static_cast<float>(light_at(view, u, v)));
                const auto noisy = [&](int code) { return static_cast<std::uint8_t>(code + noise(random)); };
                photo(x, y) = in_object(view, u, v) ? Rgba8{noisy(20), noisy(110), noisy(130), 255}
                                                    : Rgba8{noisy(grey), noisy(grey), noisy(grey), 255};
            }
        }
    }
    const Result<Backdrop> backdrop = test::backdrop_behind(photos);
    ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
    const ObjectCutter cutter(*backdrop, kWidth, kHeight);
    for (const int view : {0, 5, 9, 12}) {
        SCOPED_TRACE(view);
        const Image<Rgba8> cut = cutter.cut(photos[static_cast<std::size_t>(view)]);
        int lost = 0, added = 0;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const double u = static_cast<double>(x) / kTimes, v = static_cast<double>(y) / kTimes;
                const bool solid = cut(x, y).a >= 128, object = in_object(view, u, v);
                lost += object && !solid ? 1 : 0;
                added += !object && solid ? 1 : 0;
            }
        }
        EXPECT_LE(lost, 60) << "of 7840 and more";
        EXPECT_LE(added, 60);
    }
}

CleanPlateView studio_plate() {
    Image<LinearRgb> light(kStudio_width, kStudio_height);
    for (int y = 0; y < kStudio_height; ++y) {
        for (int x = 0; x < kStudio_width; ++x) {
            const float grey = studio_light(x, y);
            light(x, y) = {grey, grey, grey};
        }
    }
    CleanPlateView plate;
    plate.behind = SeenLight(std::move(light));
    return plate;
}

TEST(CutOutInAStudio, EdgesEncloseWhatColourDoesNotTell) {
    const ShadedBox box(3);
    const Image<Rgba8> photo = photo_of(box, 3, 0.9, 0.45);
    const MaskOptions options;
    const Image<std::uint8_t> by_colour = find_object(photo, studio_plate(), options);
    EXPECT_EQ(by_colour(static_cast<int>(box.centre_x), 60), 0);
    const Image<std::uint8_t> by_edges = find_object_by_edges(photo, studio_plate(), options);
    ASSERT_FALSE(by_edges.empty());
    EXPECT_EQ(by_edges(static_cast<int>(box.centre_x) + 20, 118), 0) << "in the shadow";
    EXPECT_EQ(by_edges(static_cast<int>(box.centre_x), 34), 0) << "through the ring";
    for (int y = 56; y < 98; ++y) {
        for (int x = static_cast<int>(box.centre_x) - 38; x < static_cast<int>(box.centre_x) + 38; ++x) {
            ASSERT_EQ(by_edges(x, y), 255) << x << ", " << y;
        }
    }
}

// A shadow within a loop is enclosed, too, but it is little beside the object.
TEST(CutOutInAStudio, LittleIsLeftToColour) {
    const ShadedBox box(3);
    Image<Rgba8> photo = photo_of(box, 3, 0.9, 0.45);
    for (int y = 0; y < kStudio_height; ++y) {
        for (int x = 0; x < kStudio_width; ++x) {
            if (box.in_body(x, y)) photo(x, y) = {20, 120, 130, 255};
            if (box.in_loop(x, y)) photo(x, y) = {170, 170, 170, 255};
        }
    }
    EXPECT_TRUE(find_object_by_edges(photo, studio_plate(), MaskOptions{}).empty());
}

// Of noise, edges are everywhere; colour decides then.
TEST(CutOutInAStudio, NoiseEnclosesNothing) {
    std::minstd_rand random(5);
    for (const int most : {0, 1, 8, 30}) {
        SCOPED_TRACE(most);
        std::uniform_int_distribution<int> noise(-most, most);
        Image<Rgba8> photo(kStudio_width, kStudio_height);
        for (Rgba8& pixel : photo.pixels()) {
            const auto at = static_cast<int>(&pixel - photo.data());
            const int code = srgb8_from_linear(studio_light(at % kStudio_width, at / kStudio_width)) + noise(random);
            const auto grey = static_cast<std::uint8_t>(std::clamp(code, 0, 255));
            pixel = {grey, grey, grey, 255};
        }
        EXPECT_TRUE(find_object_by_edges(photo, studio_plate(), MaskOptions{}).empty());
    }
}

// As photographs are: larger than the pictures in which edges are looked for.
TEST(CutOutInAStudio, LargePicturesAreCutAtTheSamePlaces) {
    constexpr int kTimes = 6;
    const ShadedBox box(3);
    const Image<Rgba8> small = photo_of(box, 3, 0.9, 0.45);
    const CleanPlateView small_plate = studio_plate();
    Image<Rgba8> photo(kStudio_width * kTimes, kStudio_height * kTimes);
    Image<LinearRgb> light(photo.width(), photo.height());
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
            photo(x, y) = small(x / kTimes, y / kTimes);
            light(x, y) = small_plate.behind.light(x / kTimes, y / kTimes);
        }
    }
    CleanPlateView plate;
    plate.behind = SeenLight(std::move(light));
    const Image<std::uint8_t> found = find_object_by_edges(photo, plate, MaskOptions{});
    ASSERT_EQ(found.width(), photo.width());
    int wrong = 0, seen = 0;
    for (int y = kTimes / 2; y < photo.height(); y += kTimes) {
        for (int x = kTimes / 2; x < photo.width(); x += kTimes) {
            const int u = x / kTimes, v = y / kTimes;
            if (!box.in_body(u, v) && !box.in_body(u - 3, v) && !box.in_body(u + 3, v) && v > 55 && v < 105) {
                wrong += found(x, y) != 0 ? 1 : 0;
                ++seen;
            }
            if (box.in_body(u - 3, v - 3) && box.in_body(u + 3, v + 3)) {
                wrong += found(x, y) == 0 ? 1 : 0;
                ++seen;
            }
        }
    }
    EXPECT_GT(seen, 10000);
    EXPECT_EQ(wrong, 0);
}

TEST(CutOutInAStudio, PicturesOfAPixelHaveNoObject) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {7, 1}}) {
        CleanPlateView plate;
        plate.behind = SeenLight(Image<LinearRgb>(width, height, {0.5F, 0.5F, 0.5F}));
        const Image<Rgba8> photo(width, height, {20, 20, 20, 255});
        EXPECT_TRUE(find_object_by_edges(photo, plate, MaskOptions{}).empty());
    }
}

// A mark on the wall is the backdrop, and a shop's name in a corner.
TEST(CutOutInAStudio, AMarkIsNoObject) {
    std::vector<Image<Rgba8>> photos = photos_of_turn(0.9, 0.45);
    const auto in_mark = [](int x, int y) { return x >= 8 && x < 40 && y >= 6 && y < 14; };
    for (Image<Rgba8>& photo : photos) {
        for (int y = 0; y < kStudio_height; ++y) {
            for (int x = 0; x < kStudio_width; ++x) {
                if (in_mark(x, y)) photo(x, y) = {20, 20, 20, 255};
            }
        }
    }
    const Result<Backdrop> backdrop = test::backdrop_behind(photos);
    ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
    const Image<Rgba8> cut = ObjectCutter(*backdrop, kStudio_width, kStudio_height).cut(photos[3]);
    EXPECT_LE(errors_of(cut, ShadedBox(3)).body_lost, 60) << "of 5400";
    for (int y = 0; y < kStudio_height; ++y) {
        for (int x = 0; x < kStudio_width; ++x) {
            if (!in_mark(x, y)) continue;
            ASSERT_LT(cut(x, y).a, 128) << x << ", " << y;
        }
    }
}

TEST(CutOutInAStudio, NothingHasNoObject) {
    const Image<Rgba8> nothing;
    EXPECT_TRUE(find_object_by_edges(nothing, CleanPlateView{}, MaskOptions{}).empty());
}

TEST(SeenLight, IsAtMostWhiteAndLooksAsItIs) {
    Image<LinearRgb> light(3, 2, {0.2F, 0.3F, 0.4F});
    light(1, 1) = {1.5F, 1.2F, 0.7F};
    const SeenLight seen(std::move(light));
    EXPECT_EQ(seen.width(), 3);
    EXPECT_EQ(seen.height(), 2);
    EXPECT_EQ(seen.light(1, 1).r, 1);
    EXPECT_EQ(seen.light(1, 1).g, 1);
    EXPECT_EQ(seen.light(1, 1).b, 0.7F);
    EXPECT_EQ(seen.light(0, 0).g, 0.3F);
    EXPECT_EQ(delta_e(seen.looks(1, 1), lab_from_linear({1, 1, 0.7F})), 0);
    EXPECT_EQ(delta_e(seen.looks(2, 1), lab_from_linear({0.2F, 0.3F, 0.4F})), 0);
}

// What is known to be seen is no object, whatever its colour.
TEST(ObjectMask, WhatIsSeenIsBackdrop) {
    CleanPlateView plate = studio_plate();
    Image<Rgba8> photo(kStudio_width, kStudio_height, {200, 20, 20, 255});
    EXPECT_EQ(object_preference(photo, plate, MaskOptions{})(10, 10), kDecided);
    plate.hidden = plate.seen = Image<std::uint8_t>(kStudio_width, kStudio_height, 255);
    EXPECT_EQ(object_preference(photo, plate, MaskOptions{})(10, 10), -kDecided);
}

// Above what the object stands on, what a shadow could explain is rather the object.
TEST(ObjectMask, AboveShadowsGreyLeansToTheObject) {
    CleanPlateView plate = studio_plate();
    const LinearRgb behind = plate.behind.light(10, 10);
    const std::uint8_t code = srgb8_from_linear(0.6F * behind.r);
    const Image<Rgba8> photo(kStudio_width, kStudio_height, {code, code, code, 255});
    MaskOptions options;
    options.shadow_or_grey = -0.1F;
    EXPECT_LT(object_preference(photo, plate, options)(10, 10), 0);
    plate.above = Image<std::uint8_t>(kStudio_width, kStudio_height);
    plate.above(10, 10) = 255;
    EXPECT_GT(object_preference(photo, plate, options)(10, 10), 0);
    EXPECT_LT(object_preference(photo, plate, options)(11, 10), 0);
    plate.ground = Image<std::uint8_t>(kStudio_width, kStudio_height, 255);  // of a turntable: it is believed
    EXPECT_EQ(object_preference(photo, plate, options)(10, 10), object_preference(photo, plate, options)(11, 10));
}

}  // namespace
}  // namespace rs::capture
