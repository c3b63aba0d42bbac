#include "capture/photos/segmentation/background_model_segmenter.hpp"

#include "rayspace/image/linear_light.hpp"
#include "tests/capture/photos/segment_photo.hpp"
#include "tests/capture/photos/turn_of_images.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rs::capture {
namespace {

BackgroundModel background_of(const test::DrawnTurn& turn) {
    Survey survey;
    survey.samples = test::draw_photos(turn);
    const Result<BackgroundModel> found = estimate_background(survey, {}, "drawn");
    EXPECT_TRUE(found.ok());
    return *found;
}

struct Errors {
    double alpha_in_band = 0;  // mean absolute, where the true alpha is fractional
    double alpha_elsewhere = 0;
    double colour_in_band = 0;  // mean absolute, sRGB codes, weighted by the true alpha
    int band_pixels = 0;
};

Errors errors_of(const test::DrawnTurn& turn) {
    const BackgroundModelSegmenter cutter(background_of(turn), turn.width, turn.height);
    Errors sum;
    double elsewhere = 0;
    double weight = 0;
    for (int i = 0; i < turn.views; i += 3) {
        const test::DrawnView view = test::draw_view(turn, i);
        const Image<Rgba8> cut = test::segment_photo(cutter, view.photo);
        for (int y = 0; y < turn.height; ++y) {
            for (int x = 0; x < turn.width; ++x) {
                const double truth = view.alpha(x, y);
                const double wrong = std::abs(cut(x, y).a / 255.0 - truth);
                if (truth > 0 && truth < 1) {
                    sum.alpha_in_band += wrong;
                    ++sum.band_pixels;
                    const Rgba8& own = view.foreground(x, y);
                    sum.colour_in_band += truth *
                                          (std::abs(cut(x, y).r - own.r) + std::abs(cut(x, y).g - own.g) +
                                           std::abs(cut(x, y).b - own.b)) /
                                          3;
                    weight += truth;
                } else {
                    sum.alpha_elsewhere += wrong;
                    ++elsewhere;
                }
            }
        }
    }
    sum.alpha_in_band /= sum.band_pixels;
    sum.alpha_elsewhere /= elsewhere;
    sum.colour_in_band /= weight;
    return sum;
}

class CutOutByBackground : public testing::TestWithParam<Rgba8> {};

TEST_P(CutOutByBackground, RecoversAlphaAndColourOfTheEdge) {
    test::DrawnTurn turn;
    turn.backdrop = GetParam();
    const Errors errors = errors_of(turn);
    EXPECT_GT(errors.band_pixels, 300);
    EXPECT_LT(errors.alpha_in_band, 0.06);
    EXPECT_LT(errors.alpha_elsewhere, 0.002);
    EXPECT_LT(errors.colour_in_band, 12);
}

INSTANTIATE_TEST_SUITE_P(Backdrops, CutOutByBackground,
                         testing::Values(Rgba8{255, 255, 255, 255}, Rgba8{0, 0, 0, 255}, Rgba8{60, 70, 180, 255},
                                         Rgba8{30, 160, 60, 255}, Rgba8{128, 128, 128, 255}));

TEST(CutOut, RemovesASoftShadow) {
    test::DrawnTurn turn;
    turn.shadow = 0.5;  // light; sRGB 255 becomes 188 in the middle
    turn.orbit_px = 30;
    const BackgroundModelSegmenter cutter(background_of(turn), turn.width, turn.height);
    for (int i = 0; i < turn.views; ++i) {
        const test::DrawnView view = test::draw_view(turn, i);
        const Image<Rgba8> cut = test::segment_photo(cutter, view.photo);
        double shadow_alpha = 0;
        double missing = 0;
        for (int y = 0; y < turn.height; ++y) {
            for (int x = 0; x < turn.width; ++x) {
                if (view.alpha(x, y) == 0) shadow_alpha += cut(x, y).a / 255.0;
                if (view.alpha(x, y) == 1) missing += 1 - cut(x, y).a / 255.0;
            }
        }
        // The disc covers 1256 px, its shadow about as many.
        EXPECT_LT(shadow_alpha, 40) << "view " << i;
        EXPECT_LT(missing, 15) << "view " << i;
    }
}

TEST(CutOut, KeepsATrueHoleOpenAndFillsAGreyInside) {
    test::DrawnTurn turn;
    const BackgroundModelSegmenter cutter(background_of(turn), turn.width, turn.height);
    Image<Rgba8> photo(turn.width, turn.height, turn.backdrop);
    for (int y = 20; y < 100; ++y) {
        for (int x = 20; x < 120; ++x) photo(x, y) = {30, 90, 110, 255};
    }
    for (int y = 40; y < 60; ++y) {
        for (int x = 30; x < 50; ++x) photo(x, y) = turn.backdrop;          // hole
        for (int x = 80; x < 110; ++x) photo(x, y) = {205, 205, 205, 255};  // grey leather
    }
    const Image<Rgba8> cut = test::segment_photo(cutter, photo);
    EXPECT_EQ(cut(40, 50).a, 0);
    EXPECT_EQ(cut(95, 50).a, 255);
    EXPECT_EQ(cut(95, 50), photo(95, 50));
    EXPECT_EQ(cut(5, 5).a, 0);
}

TEST(CutOut, RemovesSpecks) {
    test::DrawnTurn turn;
    turn.backdrop = {60, 70, 180, 255};
    const BackgroundModelSegmenter cutter(background_of(turn), turn.width, turn.height);
    Image<Rgba8> photo = test::draw_view(turn, 0).photo;
    for (int y = 100; y < 103; ++y) {
        for (int x = 10; x < 13; ++x) photo(x, y) = {230, 230, 230, 255};  // chalk
    }
    EXPECT_EQ(test::segment_photo(cutter, photo)(11, 101).a, 0);
    photo(static_cast<int>(turn.axis_x_px), turn.height / 2) = {60, 70, 180, 255};  // one pixel of the disc
    EXPECT_EQ(test::segment_photo(cutter, photo)(static_cast<int>(turn.axis_x_px), turn.height / 2).a, 255);
}

// Lamps that warm up, and a camera that adjusts its exposure: the background differs in every photo.
TEST(CutOut, AdaptsToTheExposure) {
    test::DrawnTurn turn;
    turn.backdrop = {110, 120, 150, 255};
    for (const bool jumps : {false, true}) {
        SCOPED_TRACE(jumps);
        Survey survey;
        for (int i = 0; i < turn.views; ++i) {
            Image<Rgba8> photo = test::draw_view(turn, i).photo;
            const double light = jumps ? 0.25 + 0.75 * ((5 * i) % turn.views) / turn.views : 0.7 + 0.3 * i / turn.views;
            for (Rgba8& p : photo.pixels()) p = test::mixed(p, {0, 0, 0, 255}, light);
            survey.samples.push_back(photo);
        }
        const Result<BackgroundModel> backdrop = estimate_background(survey, {}, "drawn");
        ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
        const BackgroundModelSegmenter cutter(*backdrop, turn.width, turn.height);
        for (int i = 0; i < turn.views; ++i) {
            const Image<float> truth = test::draw_view(turn, i).alpha;
            const Image<Rgba8> cut = test::segment_photo(cutter, survey.samples[static_cast<std::size_t>(i)]);
            double wrong = 0;
            for (int y = 0; y < turn.height; ++y) {
                for (int x = 0; x < turn.width; ++x) wrong += std::abs(cut(x, y).a / 255.0 - truth(x, y));
            }
            EXPECT_LT(wrong / (turn.width * turn.height), 0.01) << "view " << i;
        }
    }
}

// A painted vase: its white surface is rotationally symmetric, only its painted bands change.
TEST(CutOut, KeepsStaticSurfacesOfTheObject) {
    constexpr int kViews = 12;
    const auto inside = [](int x, int y) { return x >= 60 && x < 96 && y >= 30 && y < 90; };
    Survey survey;
    for (int i = 0; i < kViews; ++i) {
        Image<Rgba8> photo(160, 120, Rgba8{90, 100, 130, 255});
        for (int y = 0; y < 120; ++y) {
            for (int x = 0; x < 160; ++x) {
                if (!inside(x, y)) continue;
                const bool band = (y >= 38 && y < 54) || (y >= 66 && y < 86);
                const bool painted = band && (x + 5 * i) % 12 < 6;
                photo(x, y) = painted ? Rgba8{150, 40, 50, 255} : Rgba8{215, 215, 205, 255};
            }
        }
        survey.samples.push_back(photo);
    }
    const Result<BackgroundModel> backdrop = estimate_background(survey, {}, "drawn");
    ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
    EXPECT_EQ(backdrop->always_covered(78, 60), 255) << "the surface between the bands";
    EXPECT_EQ(backdrop->always_covered(20, 60), 0);
    EXPECT_EQ(backdrop->always_visible(20, 60), 255);
    const Image<Rgba8> cut = test::segment_photo(BackgroundModelSegmenter(*backdrop, 160, 120), survey.samples[0]);
    for (int y = 40; y < 80; ++y) {
        for (int x = 66; x < 90; ++x) ASSERT_EQ(cut(x, y).a, 255) << x << "," << y;
    }
    EXPECT_EQ(cut(40, 60).a, 0);
}

// The lamp is static, so the core of a shadow on the disc never changes; only its contour does.
TEST(CutOut, RemovesAStaticShadow) {
    constexpr int kViews = 12;
    const Rgba8 disc{180, 180, 185, 255};
    const Rgba8 shaded = test::mixed(disc, {0, 0, 0, 255}, 0.6);
    Survey survey;
    for (int i = 0; i < kViews; ++i) {
        Image<Rgba8> photo(160, 120, disc);
        for (int y = 0; y < 120; ++y) {
            for (int x = 0; x < 160; ++x) {
                const bool object = x >= 70 && x < 106 && y >= 20 && y < 90;
                const int fringe = (y / 3 + 5 * i) % 7;  // leaves and petals
                if (object) {
                    photo(x, y) = (x / 4 + y / 4 + i) % 2 == 0 ? Rgba8{170, 60, 40, 255} : Rgba8{60, 110, 40, 255};
                } else if (x >= 38 - fringe && x < 70 && y >= 60 - fringe && y < 86 + fringe) {
                    photo(x, y) = shaded;
                }
            }
        }
        survey.samples.push_back(photo);
    }
    const Result<BackgroundModel> backdrop = estimate_background(survey, {}, "drawn");
    ASSERT_TRUE(backdrop.ok()) << backdrop.error().message;
    EXPECT_EQ(backdrop->always_covered(55, 72), 0);
    const Image<Rgba8> cut = test::segment_photo(BackgroundModelSegmenter(*backdrop, 160, 120), survey.samples[0]);
    for (int y = 64; y < 82; ++y) {
        for (int x = 42; x < 66; ++x) ASSERT_EQ(cut(x, y).a, 0) << x << "," << y;
        for (int x = 74; x < 102; ++x) ASSERT_EQ(cut(x, y).a, 255) << x << "," << y;
    }
}

// A block on a wire before a plate known per pixel, and beside it a broad soft shadow of the same colour as the wire.
TEST(ForegroundMask, ThinStructuresAreNotShadows) {
    constexpr int kWidth = 240;
    constexpr int kHeight = 180;
    const Rgba8 background{150, 142, 132, 255};
    const Rgba8 shaded = test::mixed(background, {0, 0, 0, 255}, 0.65);
    Image<Rgba8> photo(kWidth, kHeight, background);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            if (x >= 60 && x < 100 && y >= 20 && y < 60) photo(x, y) = {40, 60, 170, 255};
            if (x >= 78 && x < 81 && y >= 60 && y < 150) photo(x, y) = shaded;
            const double outside_px =
                std::hypot(std::max(0, std::abs(x - 180) - 20), std::max(0, std::abs(y - 100) - 20));
            const double depth = std::clamp(1 - outside_px / 25, 0.0, 1.0);
            if (depth > 0) photo(x, y) = test::mixed(shaded, background, depth);
        }
    }
    CleanPlateView plate;
    plate.background = LinearLabImage(Image<LinearRgb>(kWidth, kHeight, linear_rgb(background)));
    BackgroundModel model;
    model.kind = BackgroundKind::kColour;
    model.always_visible = Image<std::uint8_t>(kWidth, kHeight, 255);
    ForegroundParameters parameters = parameters_for(model, {});
    const Image<std::uint8_t> mask = segment_foreground(photo, plate, parameters);
    EXPECT_EQ(mask(70, 40), 255);
    for (int y = 64; y < 148; ++y) ASSERT_EQ(mask(79, y), 255) << y;
    EXPECT_EQ(mask(180, 100), 0);
    parameters.score.thin_delta_e = 0;
    EXPECT_EQ(segment_foreground(photo, plate, parameters)(79, 110), 0) << "the wire is kept by this test alone";
}

// A body on two legs with a deep shadow between them. It is background on the disc, where shadows fall.
TEST(ForegroundMask, DeepShadowsBetweenFeetAreBackgroundOnTheDisc) {
    constexpr int kWidth = 240;
    constexpr int kHeight = 180;
    const Rgba8 background{190, 186, 180, 255};
    Image<Rgba8> photo(kWidth, kHeight, background);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            if (x < 60 || x >= 180 || y < 40 || y >= 140) continue;
            const bool between = x >= 90 && x < 150 && y >= 80;
            const LinearRgb light = linear_rgb(background);
            const float left = y < 120 ? 0.12F : 0.5F + 0.5F * static_cast<float>(y - 120) / 20;
            photo(x, y) = between ? Rgba8{srgb8_from_linear(left * light.r), srgb8_from_linear(left * light.g),
                                          srgb8_from_linear(left * light.b), 255}
                                  : Rgba8{150, 85, 40, 255};
        }
    }
    CleanPlateView plate;
    plate.background = LinearLabImage(Image<LinearRgb>(kWidth, kHeight, linear_rgb(background)));
    plate.disc = Image<std::uint8_t>(kWidth, kHeight, 255);
    BackgroundModel model;
    model.kind = BackgroundKind::kColour;
    model.always_visible = Image<std::uint8_t>(kWidth, kHeight, 255);
    const ForegroundParameters parameters = parameters_for(model, {});
    const Image<std::uint8_t> mask = segment_foreground(photo, plate, parameters);
    EXPECT_EQ(mask(120, 60), 255);
    EXPECT_EQ(mask(75, 120), 255);
    for (int y = 84; y < 140; ++y) ASSERT_EQ(mask(120, y), 0) << y;
    plate.disc = Image<std::uint8_t>(kWidth, kHeight, 0);
    EXPECT_EQ(segment_foreground(photo, plate, parameters)(120, 90), 255)
        << "off the disc it is a crevice of the object";
}

TEST(CutOut, PreservesTheAlphaOfTheInput) {
    Image<Rgba8> photo(60, 40, Rgba8{9, 9, 9, 0});
    for (int y = 10; y < 30; ++y) {
        for (int x = 10; x < 50; ++x) {
            photo(x, y) = {static_cast<std::uint8_t>(3 * x), static_cast<std::uint8_t>(5 * y), 77,
                           static_cast<std::uint8_t>(1 + 6 * (x - 10))};
        }
    }
    Image<std::uint8_t> alpha(60, 40);
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 60; ++x) alpha(x, y) = photo(x, y).a;
    }
    const Image<Rgba8> cut = make_foreground_image(photo, Segmentation{alpha, true});
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 60; ++x) {
            if (photo(x, y).a > 0) {
                ASSERT_EQ(cut(x, y), photo(x, y)) << x << "," << y;
            } else {
                ASSERT_EQ(cut(x, y).a, 0) << x << "," << y;
            }
        }
    }
    // Colours are continued beyond the edge: (49, 20) is the opaque pixel nearest to (52, 20).
    EXPECT_EQ(cut(52, 20).r, photo(49, 20).r);
    EXPECT_EQ(cut(52, 20).b, 77);
}

TEST(BleedColours, ReachesExactlyTheGivenDistance) {
    Image<Rgba8> image(100, 3, Rgba8{1, 2, 3, 0});
    for (int y = 0; y < 3; ++y) image(10, y) = {200, 100, 50, 255};
    bleed_colours(image);
    EXPECT_EQ(image(10 + kBleed_px, 1), (Rgba8{200, 100, 50, 0}));
    EXPECT_EQ(image(10 + kBleed_px + 2, 1), (Rgba8{0, 0, 0, 0}));
    Image<Rgba8> empty(5, 5, Rgba8{9, 9, 9, 0});
    bleed_colours(empty);
    EXPECT_EQ(empty(2, 2), (Rgba8{0, 0, 0, 0}));
}

}  // namespace
}  // namespace rs::capture
