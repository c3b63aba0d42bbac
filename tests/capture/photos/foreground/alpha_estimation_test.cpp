#include "capture/photos/foreground/alpha_estimation.hpp"

#include "tests/capture/photos/turn_of_images.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace rs::capture {
namespace {

constexpr int kSide_px = 120;
constexpr double kEdgeRadius_px = 40;

// A disc of wood grain before a noisy background, neither of uniform colour, with its true alpha.
struct TestPhoto {
    Image<Rgba8> photo{kSide_px, kSide_px};
    Image<float> alpha{kSide_px, kSide_px};
};

double distance_inside(int x, int y) {
    return kEdgeRadius_px - std::hypot(x + 0.5 - kSide_px / 2.0, y + 0.5 - kSide_px / 2.0);
}

TestPhoto draw_textured(double grey = 165) {
    TestPhoto drawn;
    std::minstd_rand random(1);
    std::normal_distribution<double> noise(0, 6);
    for (int y = 0; y < kSide_px; ++y) {
        for (int x = 0; x < kSide_px; ++x) {
            const double alpha = std::clamp(distance_inside(x, y) + 0.5, 0.0, 1.0);
            const auto code = [](double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)); };
            const double dark = (x / 3 + y / 5) % 2 == 0 ? -22 : 22;
            const double background = grey + noise(random);
            drawn.alpha(x, y) = static_cast<float>(alpha);
            drawn.photo(x, y) = test::mixed({code(205 + dark), code(160 + dark), code(95 + dark), 255},
                                            {code(background), code(background), code(background), 255}, alpha);
        }
    }
    return drawn;
}

struct AlphaError {
    double mean_absolute = 0;
    double mean = 0;
};

// Error within 2.5 px of the contour, from a mask whose contour lies `dilation_px` outside the true one.
AlphaError error_in_band(const TestPhoto& drawn, double dilation_px) {
    Image<std::uint8_t> mask(kSide_px, kSide_px);
    for (int y = 0; y < kSide_px; ++y) {
        for (int x = 0; x < kSide_px; ++x) mask(x, y) = distance_inside(x, y) > -dilation_px ? 255 : 0;
    }
    const AlphaEstimate estimate = estimate_alpha(drawn.photo, mask, 2);
    AlphaError error;
    int count = 0;
    for (int y = 0; y < kSide_px; ++y) {
        for (int x = 0; x < kSide_px; ++x) {
            if (std::abs(distance_inside(x, y)) > 2.5) continue;
            error.mean_absolute += std::abs(estimate.alpha(x, y) - drawn.alpha(x, y));
            error.mean += estimate.alpha(x, y) - drawn.alpha(x, y);
            ++count;
        }
    }
    return {error.mean_absolute / count, error.mean / count};
}

TEST(EstimateAlpha, ToleratesTextureAndNoise) {
    const AlphaError error = error_in_band(draw_textured(), 0);
    EXPECT_LT(error.mean_absolute, 0.02);
    EXPECT_LT(std::abs(error.mean), 0.01);
}

TEST(EstimateAlpha, CorrectsADilatedMask) {
    const AlphaError error = error_in_band(draw_textured(), 1);
    EXPECT_LT(error.mean_absolute, 0.02);
    EXPECT_LT(error.mean, 0.015);
}

// Defocus: alpha rises from 0 to 1 over more than a pixel.
TestPhoto draw_blurred() {
    TestPhoto drawn;
    std::minstd_rand random(1);
    std::normal_distribution<double> noise(0, 2);
    for (int y = 0; y < kSide_px; ++y) {
        for (int x = 0; x < kSide_px; ++x) {
            const double alpha = 0.5 * std::erfc(-distance_inside(x, y) / std::sqrt(2.0));
            const auto code = [&](double value) { return static_cast<std::uint8_t>(value + noise(random)); };
            drawn.alpha(x, y) = static_cast<float>(alpha);
            drawn.photo(x, y) =
                test::mixed({code(200), code(150), code(90), 255}, {code(60), code(70), code(110), 255}, alpha);
        }
    }
    return drawn;
}

TEST(EstimateAlpha, AdaptsToBlur) {
    EXPECT_LT(error_in_band(draw_blurred(), 0).mean_absolute, 0.03);
    EXPECT_LT(error_in_band(draw_blurred(), 1).mean_absolute, 0.03);
}

// JPEG 4:2:0: four pixels share their chroma.
TEST(EstimateAlpha, ToleratesSubsampledChroma) {
    TestPhoto drawn = draw_textured(100);
    for (int y = 0; y + 1 < kSide_px; y += 2) {
        for (int x = 0; x + 1 < kSide_px; x += 2) {
            std::array<Rgba8*, 4> pixels{&drawn.photo(x, y), &drawn.photo(x + 1, y), &drawn.photo(x, y + 1),
                                         &drawn.photo(x + 1, y + 1)};
            const auto luma = [](const Rgba8& p) { return 0.299 * p.r + 0.587 * p.g + 0.114 * p.b; };
            double red = 0;
            double blue = 0;
            for (const Rgba8* p : pixels) {
                red += (p->r - luma(*p)) / 4;
                blue += (p->b - luma(*p)) / 4;
            }
            for (Rgba8* p : pixels) {
                const double own = luma(*p);
                const double green = (own - 0.299 * (own + red) - 0.114 * (own + blue)) / 0.587;
                const auto code = [](double v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0, 255.0)); };
                *p = {code(own + red), code(green), code(own + blue), 255};
            }
        }
    }
    EXPECT_LT(error_in_band(drawn, 0).mean_absolute, 0.055);
}

TEST(EstimateAlpha, AcceptsEmptyImagesAndMasks) {
    EXPECT_TRUE(estimate_alpha(Image<Rgba8>(), Image<std::uint8_t>(), 2).alpha.empty());
    const AlphaEstimate none = estimate_alpha(draw_textured().photo, Image<std::uint8_t>(kSide_px, kSide_px), 2);
    EXPECT_EQ(none.alpha(kSide_px / 2, kSide_px / 2), 0);
}

}  // namespace
}  // namespace rs::capture
