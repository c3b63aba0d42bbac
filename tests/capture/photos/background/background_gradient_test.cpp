// Background gradient of a studio, around the object and behind it.

#include "capture/photos/background/background_gradient.hpp"
#include "rayspace/image/linear_light.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

namespace rs::capture {
namespace {

constexpr int kPlate_width = 160, kPlate_height = 100;

// Code of the background: brighter at the top, darker at the bottom and in the corners.
double studio_code(int x, int y) {
    const double u = (x - 80) / 80.0, v = (y - 50) / 50.0;
    return 205 - 18 * v - 12 * u * u - 8 * v * v + 3 * u;
}

bool in_middle(int x, int y) {
    return std::abs(x - 80) < 55 && std::abs(y - 50) < 35;
}

struct Studio {
    Image<Rgba8> plate{kPlate_width, kPlate_height};
    Image<std::uint8_t> always_visible{kPlate_width, kPlate_height};

    // `middle`: colour of the object.
    explicit Studio(Rgba8 middle) {
        std::minstd_rand random(3);
        std::uniform_int_distribution<int> noise(-1, 1);
        for (int y = 0; y < kPlate_height; ++y) {
            for (int x = 0; x < kPlate_width; ++x) {
                const auto code = static_cast<std::uint8_t>(std::lround(studio_code(x, y)) + noise(random));
                plate(x, y) = in_middle(x, y) ? middle : Rgba8{code, code, static_cast<std::uint8_t>(code - 6), 255};
                always_visible(x, y) = in_middle(x, y) ? 0 : 255;
            }
        }
    }
};

Rgba8 codes_at(const Image<LinearRgb>& light, int x, int y) {
    const LinearRgb& p = light(x, y);
    return {srgb8_from_linear(p.r), srgb8_from_linear(p.g), srgb8_from_linear(p.b), 255};
}

TEST(BackgroundGradient, ContinuesBehindTheObject) {
    const Studio studio(Rgba8{250, 250, 250, 255});
    const Image<LinearRgb> gradient = fit_background_gradient(studio.plate, studio.always_visible, {});
    ASSERT_EQ(gradient.width(), kPlate_width);
    ASSERT_EQ(gradient.height(), kPlate_height);
    double worst = 0;
    for (int y = 0; y < kPlate_height; ++y) {
        for (int x = 0; x < kPlate_width; ++x) {
            const Rgba8 code = codes_at(gradient, x, y);
            worst = std::max({worst, std::abs(code.r - studio_code(x, y)), std::abs(code.b - (studio_code(x, y) - 6))});
        }
    }
    EXPECT_LE(worst, 1.2);
}

TEST(BackgroundGradient, IsRobustToASoftShadow) {
    Studio studio(Rgba8{250, 250, 250, 255});
    for (int y = 88; y < 96; ++y) {
        for (int x = 70; x < 90; ++x) {
            for (std::uint8_t* c : {&studio.plate(x, y).r, &studio.plate(x, y).g, &studio.plate(x, y).b}) {
                *c = static_cast<std::uint8_t>(*c - 20);
            }
        }
    }
    const Image<LinearRgb> gradient = fit_background_gradient(studio.plate, studio.always_visible, {});
    ASSERT_FALSE(gradient.empty());
    EXPECT_NEAR(codes_at(gradient, 80, 50).g, studio_code(80, 50), 1.5);
}

// A wall above a table: below a line that descends by `slope` px per px to the right, three quarters of the code.
double with_horizon(int x, int y, double slope) {
    const double below = y - 60 - slope * (x - 80);
    return studio_code(x, y) * (1 - 0.125 * (1 + std::tanh(below / 3)));
}

Studio with_horizon(double slope) {
    Studio studio(Rgba8{250, 250, 250, 255});
    for (int y = 0; y < kPlate_height; ++y) {
        for (int x = 0; x < kPlate_width; ++x) {
            const auto code = static_cast<std::uint8_t>(std::lround(with_horizon(x, y, slope)));
            if (!in_middle(x, y)) studio.plate(x, y) = {code, code, code, 255};
        }
    }
    return studio;
}

TEST(BackgroundGradient, ContinuesAHorizonBehindTheObject) {
    for (const double slope : {0.0, 0.05, -0.05}) {
        SCOPED_TRACE(slope);
        const Studio studio = with_horizon(slope);
        const Image<LinearRgb> gradient = fit_background_gradient(studio.plate, studio.always_visible, {});
        ASSERT_FALSE(gradient.empty());
        double worst = 0;
        for (int y = 0; y < kPlate_height; ++y) {
            for (int x = 0; x < kPlate_width; ++x) {
                worst = std::max(worst, std::abs(codes_at(gradient, x, y).g - with_horizon(x, y, slope)));
            }
        }
        EXPECT_LE(worst, 3);
    }
}

// Rows in which only the object and its shadow are visible.
TEST(BackgroundGradient, InterpolatesCoveredRows) {
    Studio studio(Rgba8{250, 250, 250, 255});
    for (int y = 70; y < 78; ++y) {
        for (int x = 0; x < kPlate_width; ++x) {
            studio.always_visible(x, y) = 0;
            studio.plate(x, y) = {60, 60, 60, 255};
        }
    }
    const Image<LinearRgb> gradient = fit_background_gradient(studio.plate, studio.always_visible, {});
    ASSERT_FALSE(gradient.empty());
    EXPECT_NEAR(codes_at(gradient, 5, 74).g, studio_code(5, 74), 1.5);
    EXPECT_NEAR(codes_at(gradient, 80, 74).g, studio_code(80, 74), 1.5);
}

// A shop's name, a dark card that reaches beyond the band, and a seam.
TEST(BackgroundGradient, KeepsIsolatedMarks) {
    const std::pair<int, int> on_mark{30, 8}, on_card{12, 40}, on_seam{150, 60};
    Studio studio(Rgba8{250, 250, 250, 255});
    const auto fill = [&](int from_x, int to_x, int from_y, int to_y, double share) {
        for (int y = from_y; y < to_y; ++y) {
            for (int x = from_x; x < to_x; ++x) {
                const auto code = static_cast<std::uint8_t>(std::lround(share * studio_code(x, y)));
                studio.plate(x, y) = {code, code, code, 255};
            }
        }
    };
    fill(8, 50, 5, 11, 0.1);
    fill(4, 19, 36, 46, 0.8);
    fill(149, 152, 45, 95, 0.9);
    const Image<LinearRgb> gradient = fit_background_gradient(studio.plate, studio.always_visible, {});
    ASSERT_FALSE(gradient.empty());
    for (const auto& [x, y] : {on_mark, on_card, on_seam}) {
        SCOPED_TRACE(x);
        EXPECT_NEAR(codes_at(gradient, x, y).g, studio.plate(x, y).g, 1);
    }
    for (const auto& [x, y] : {std::pair{30, 14}, {12, 52}, {156, 60}, {80, 8}, {80, 40}}) {
        SCOPED_TRACE(x);
        EXPECT_NEAR(codes_at(gradient, x, y).g, studio_code(x, y), 1.5) << "beside the marks";
    }
}

// It continues behind the object.
TEST(BackgroundGradient, RejectsADarkTable) {
    Studio studio(Rgba8{250, 250, 250, 255});
    for (int y = 60; y < kPlate_height; ++y) {
        for (int x = 12; x < kPlate_width - 12; ++x) {
            if (in_middle(x, y)) continue;
            const auto code = static_cast<std::uint8_t>(std::lround(0.88 * studio_code(x, y)));
            studio.plate(x, y) = {code, code, code, 255};
        }
    }
    EXPECT_TRUE(fit_background_gradient(studio.plate, studio.always_visible, {}).empty());
}

TEST(BackgroundGradient, RejectsAVerticalEdge) {
    Studio studio(Rgba8{250, 250, 250, 255});
    for (int y = 0; y < kPlate_height; ++y) {
        for (int x = 100; x < kPlate_width; ++x) studio.plate(x, y) = {120, 120, 120, 255};
    }
    EXPECT_TRUE(fit_background_gradient(studio.plate, studio.always_visible, {}).empty());
}

// It continues behind the object, and little of it is visible.
TEST(BackgroundGradient, RejectsATurntable) {
    Studio studio(Rgba8{250, 250, 250, 255});
    for (int y = 0; y < kPlate_height; ++y) {
        for (int x = 0; x < kPlate_width; ++x) {
            if (std::hypot((x - 80) / 60.0, (y - 78) / 12.0) < 1) studio.plate(x, y) = {235, 235, 235, 255};
        }
    }
    EXPECT_TRUE(fit_background_gradient(studio.plate, studio.always_visible, {}).empty());
}

TEST(BackgroundGradient, NeedsAllSidesOfTheBorder) {
    Studio studio(Rgba8{250, 250, 250, 255});
    for (int y = 0; y < kPlate_height; ++y) {
        for (int x = 14; x < kPlate_width; ++x) studio.always_visible(x, y) = 0;
    }
    EXPECT_TRUE(fit_background_gradient(studio.plate, studio.always_visible, {}).empty());
    EXPECT_TRUE(fit_background_gradient(Image<Rgba8>{}, Image<std::uint8_t>{}, {}).empty());
    EXPECT_TRUE(fit_background_gradient(Image<Rgba8>(1, 1), Image<std::uint8_t>(1, 1), {}).empty());
}

}  // namespace
}  // namespace rs::capture
