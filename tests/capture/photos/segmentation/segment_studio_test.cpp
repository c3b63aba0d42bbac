// White and grey objects before the light gradient of a studio: their sides have the colour of a shadow on it.

#include "capture/photos/foreground/foreground_mask.hpp"
#include "capture/photos/segmentation/background_model_segmenter.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/image/linear_light.hpp"
#include "tests/capture/photos/segment_photo.hpp"

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

// A box that swings to and fro, with a black wheel below and a black ring with an open loop above. Its shadow lies on
// the ground before it, darkest at the box.
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

// `top_share` and `bottom_share`: light of the body relative to the background at its top and bottom.
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

TEST(CutOutInAStudio, KeepsSidesInTheColourOfAShadowAndRemovesTheShadow) {
    for (const auto& [top, bottom] : {std::pair{0.9, 0.45}, {0.8, 0.55}, {0.6, 0.5}}) {
        SCOPED_TRACE(top);
        const std::vector<Image<Rgba8>> photos = photos_of_turn(top, bottom);
        const Result<BackgroundModel> backdrop = test::backdrop_behind(photos);
        ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
        const BackgroundModelSegmenter cutter(*backdrop, kStudio_width, kStudio_height);
        for (const int view : {0, 3, 7}) {
            SCOPED_TRACE(view);
            const StudioErrors errors =
                errors_of(test::segment_photo(cutter, photos[static_cast<std::size_t>(view)]), ShadedBox(view));
            EXPECT_LE(errors.body_lost, 60) << "of 5400";
            EXPECT_LE(errors.added, 150);
            EXPECT_LE(errors.loop_closed, 10) << "of 197";
        }
    }
}

// The core of the shadow is at one place in most photos, so that the most frequent value there is the shadow. The floor
// must not become foreground in the other photos, where it is lit.
TEST(CutOutInAStudio, RemovesTheFloorThatIsLitInSomePhotosOnly) {
    constexpr int kTimes = 2, kViews = 36, kWidth = kTimes * kStudio_width, kHeight = kTimes * kStudio_height;
    // Broad from the side and narrow from the front, like a shoe; in studio pixels.
    const auto reach = [](int view) { return 14 + 46 * std::abs(std::cos(2 * kPi * view / kViews)); };
    const auto ground = [](int view) { return 110 + 4 * std::abs(std::sin(2 * kPi * view / kViews)); };
    const auto in_object = [&](int view, double x, double y) {
        return std::abs(x - 120) < reach(view) && y >= 40 && y < ground(view);
    };
    // Light of wall and floor with the shadow.
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
    const Result<BackgroundModel> backdrop = test::backdrop_behind(photos);
    ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
    const BackgroundModelSegmenter cutter(*backdrop, kWidth, kHeight);
    for (const int view : {0, 5, 9, 12}) {
        SCOPED_TRACE(view);
        const Image<Rgba8> cut = test::segment_photo(cutter, photos[static_cast<std::size_t>(view)]);
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
    plate.background = LinearLabImage(std::move(light));
    return plate;
}

TEST(CutOutInAStudio, EdgesEncloseABodyInTheColourOfAShadow) {
    const ShadedBox box(3);
    const Image<Rgba8> photo = photo_of(box, 3, 0.9, 0.45);
    const ForegroundParameters parameters;
    const Image<std::uint8_t> by_colour = segment_foreground(photo, studio_plate(), parameters);
    EXPECT_EQ(by_colour(static_cast<int>(box.centre_x), 60), 0);
    const Image<std::uint8_t> by_edges = segment_by_edges(photo, studio_plate(), parameters);
    ASSERT_FALSE(by_edges.empty());
    EXPECT_EQ(by_edges(static_cast<int>(box.centre_x) + 20, 118), 0) << "in the shadow";
    EXPECT_EQ(by_edges(static_cast<int>(box.centre_x), 34), 0) << "in the loop of the ring";
    for (int y = 56; y < 98; ++y) {
        for (int x = static_cast<int>(box.centre_x) - 38; x < static_cast<int>(box.centre_x) + 38; ++x) {
            ASSERT_EQ(by_edges(x, y), 255) << x << ", " << y;
        }
    }
}

// A shadow within a loop is enclosed, too, but small relative to the object.
TEST(CutOutInAStudio, SmallEnclosedAreasAreNotUsed) {
    const ShadedBox box(3);
    Image<Rgba8> photo = photo_of(box, 3, 0.9, 0.45);
    for (int y = 0; y < kStudio_height; ++y) {
        for (int x = 0; x < kStudio_width; ++x) {
            if (box.in_body(x, y)) photo(x, y) = {20, 120, 130, 255};
            if (box.in_loop(x, y)) photo(x, y) = {170, 170, 170, 255};
        }
    }
    EXPECT_TRUE(segment_by_edges(photo, studio_plate(), ForegroundParameters{}).empty());
}

// Noise causes edges everywhere; the method by edges must decline.
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
        EXPECT_TRUE(segment_by_edges(photo, studio_plate(), ForegroundParameters{}).empty());
    }
}

// Photos are larger than Enclosed::max_side_px.
TEST(CutOutInAStudio, LargePhotosGiveTheSameContour) {
    constexpr int kTimes = 6;
    const ShadedBox box(3);
    const Image<Rgba8> small = photo_of(box, 3, 0.9, 0.45);
    const CleanPlateView small_plate = studio_plate();
    Image<Rgba8> photo(kStudio_width * kTimes, kStudio_height * kTimes);
    Image<LinearRgb> light(photo.width(), photo.height());
    for (int y = 0; y < photo.height(); ++y) {
        for (int x = 0; x < photo.width(); ++x) {
            photo(x, y) = small(x / kTimes, y / kTimes);
            light(x, y) = small_plate.background.light(x / kTimes, y / kTimes);
        }
    }
    CleanPlateView plate;
    plate.background = LinearLabImage(std::move(light));
    const Image<std::uint8_t> found = segment_by_edges(photo, plate, ForegroundParameters{});
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

TEST(CutOutInAStudio, ImagesOfOnePixelHaveNoObject) {
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {7, 1}}) {
        CleanPlateView plate;
        plate.background = LinearLabImage(Image<LinearRgb>(width, height, {0.5F, 0.5F, 0.5F}));
        const Image<Rgba8> photo(width, height, {20, 20, 20, 255});
        EXPECT_TRUE(segment_by_edges(photo, plate, ForegroundParameters{}).empty());
    }
}

// A logo on the wall, or a shop's name in a corner, is background.
TEST(CutOutInAStudio, IgnoresALogo) {
    std::vector<Image<Rgba8>> photos = photos_of_turn(0.9, 0.45);
    const auto in_logo = [](int x, int y) { return x >= 8 && x < 40 && y >= 6 && y < 14; };
    for (Image<Rgba8>& photo : photos) {
        for (int y = 0; y < kStudio_height; ++y) {
            for (int x = 0; x < kStudio_width; ++x) {
                if (in_logo(x, y)) photo(x, y) = {20, 20, 20, 255};
            }
        }
    }
    const Result<BackgroundModel> backdrop = test::backdrop_behind(photos);
    ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
    const Image<Rgba8> cut =
        test::segment_photo(BackgroundModelSegmenter(*backdrop, kStudio_width, kStudio_height), photos[3]);
    EXPECT_LE(errors_of(cut, ShadedBox(3)).body_lost, 60) << "of 5400";
    for (int y = 0; y < kStudio_height; ++y) {
        for (int x = 0; x < kStudio_width; ++x) {
            if (!in_logo(x, y)) continue;
            ASSERT_LT(cut(x, y).a, 128) << x << ", " << y;
        }
    }
}

TEST(CutOutInAStudio, AcceptsAnEmptyImage) {
    const Image<Rgba8> empty;
    EXPECT_TRUE(segment_by_edges(empty, CleanPlateView{}, ForegroundParameters{}).empty());
}

TEST(LinearLabImage, ClipsToWhiteAndConvertsToLab) {
    Image<LinearRgb> light(3, 2, {0.2F, 0.3F, 0.4F});
    light(1, 1) = {1.5F, 1.2F, 0.7F};
    const LinearLabImage image(std::move(light));
    EXPECT_EQ(image.width(), 3);
    EXPECT_EQ(image.height(), 2);
    EXPECT_EQ(image.light(1, 1).r, 1);
    EXPECT_EQ(image.light(1, 1).g, 1);
    EXPECT_EQ(image.light(1, 1).b, 0.7F);
    EXPECT_EQ(image.light(0, 0).g, 0.3F);
    EXPECT_EQ(delta_e(image.lab(1, 1), lab_from_linear({1, 1, 0.7F})), 0);
    EXPECT_EQ(delta_e(image.lab(2, 1), lab_from_linear({0.2F, 0.3F, 0.4F})), 0);
}

TEST(ForegroundMask, VisibleBackgroundIsCertainWhateverItsColour) {
    CleanPlateView plate = studio_plate();
    Image<Rgba8> photo(kStudio_width, kStudio_height, {200, 20, 20, 255});
    EXPECT_EQ(foreground_score(photo, plate, {})(10, 10), kCertainScore);
    plate.occluded = plate.visible = Image<std::uint8_t>(kStudio_width, kStudio_height, 255);
    EXPECT_EQ(foreground_score(photo, plate, {})(10, 10), -kCertainScore);
}

// No shadow falls above the ground below the object.
TEST(ForegroundMask, AmbiguousPixelsAboveShadowsAreRatherForeground) {
    CleanPlateView plate = studio_plate();
    const LinearRgb background = plate.background.light(10, 10);
    const std::uint8_t code = srgb8_from_linear(0.6F * background.r);
    const Image<Rgba8> photo(kStudio_width, kStudio_height, {code, code, code, 255});
    ForegroundParameters::Score parameters;
    parameters.ambiguous_score = -0.1F;
    EXPECT_LT(foreground_score(photo, plate, parameters)(10, 10), 0);
    plate.above_shadows = Image<std::uint8_t>(kStudio_width, kStudio_height);
    plate.above_shadows(10, 10) = 255;
    EXPECT_GT(foreground_score(photo, plate, parameters)(10, 10), 0);
    EXPECT_LT(foreground_score(photo, plate, parameters)(11, 10), 0);
    plate.disc = Image<std::uint8_t>(kStudio_width, kStudio_height, 255);  // takes precedence
    EXPECT_EQ(foreground_score(photo, plate, parameters)(10, 10), foreground_score(photo, plate, parameters)(11, 10));
}

}  // namespace
}  // namespace rs::capture
