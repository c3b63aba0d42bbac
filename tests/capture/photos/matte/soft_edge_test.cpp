#include "capture/photos/matte/soft_edge.hpp"

#include "tests/capture/photos/turn_of_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace rs::capture {
namespace {

constexpr int kSide_px = 120;
constexpr double kEdgeRadius_px = 40;

// A disc of wood grain before a backdrop of noise, both far from one colour.
struct Grain {
    Image<Rgba8> photo{kSide_px, kSide_px};
    Image<float> alpha{kSide_px, kSide_px};
};

double distance_inside(int x, int y) {
    return kEdgeRadius_px - std::hypot(x + 0.5 - kSide_px / 2.0, y + 0.5 - kSide_px / 2.0);
}

Grain draw_grain(double grey = 165) {
    Grain drawn;
    std::minstd_rand random(1);
    std::normal_distribution<double> noise(0, 6);
    for (int y = 0; y < kSide_px; ++y) {
        for (int x = 0; x < kSide_px; ++x) {
            const double alpha = std::clamp(distance_inside(x, y) + 0.5, 0.0, 1.0);
            const auto code = [](double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)); };
            const double dark = (x / 3 + y / 5) % 2 == 0 ? -22 : 22;
            const double behind = grey + noise(random);
            drawn.alpha(x, y) = static_cast<float>(alpha);
            drawn.photo(x, y) = test::mixed({code(205 + dark), code(160 + dark), code(95 + dark), 255},
                                            {code(behind), code(behind), code(behind), 255}, alpha);
        }
    }
    return drawn;
}

struct Wrong {
    double absolute = 0;
    double signed_mean = 0;
};

// Over the 5 px along the border, from a mask that lies `fat_px` outside it.
Wrong wrong_in_band(const Grain& drawn, double fat_px) {
    Image<std::uint8_t> mask(kSide_px, kSide_px);
    for (int y = 0; y < kSide_px; ++y) {
        for (int x = 0; x < kSide_px; ++x) mask(x, y) = distance_inside(x, y) > -fat_px ? 255 : 0;
    }
    const SoftEdge edge = soften_edge(drawn.photo, mask, 2);
    Wrong wrong;
    int count = 0;
    for (int y = 0; y < kSide_px; ++y) {
        for (int x = 0; x < kSide_px; ++x) {
            if (std::abs(distance_inside(x, y)) > 2.5) continue;
            wrong.absolute += std::abs(edge.alpha(x, y) - drawn.alpha(x, y));
            wrong.signed_mean += edge.alpha(x, y) - drawn.alpha(x, y);
            ++count;
        }
    }
    return {wrong.absolute / count, wrong.signed_mean / count};
}

TEST(SoftenEdge, IsNotMisledByGrainAndNoise) {
    const Wrong wrong = wrong_in_band(draw_grain(), 0);
    EXPECT_LT(wrong.absolute, 0.02);
    EXPECT_LT(std::abs(wrong.signed_mean), 0.01);
}

TEST(SoftenEdge, MendsAMaskThatLiesOutside) {
    const Wrong wrong = wrong_in_band(draw_grain(), 1);
    EXPECT_LT(wrong.absolute, 0.02);
    EXPECT_LT(wrong.signed_mean, 0.015);
}

// Like a lens that is a little out of focus: alpha takes more than a pixel from 0 to 1.
Grain draw_blurred() {
    Grain drawn;
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

TEST(SoftenEdge, FollowsTheBlurOfThePicture) {
    EXPECT_LT(wrong_in_band(draw_blurred(), 0).absolute, 0.03);
    EXPECT_LT(wrong_in_band(draw_blurred(), 1).absolute, 0.03);
}

// As JPEG 4:2:0 keeps it: four pixels share one colour, each has a brightness of its own.
TEST(SoftenEdge, IsNotMisledByColoursOfHalfTheResolution) {
    Grain drawn = draw_grain(100);
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
    EXPECT_LT(wrong_in_band(drawn, 0).absolute, 0.055);
}

TEST(SoftenEdge, TakesEmptyPicturesAndMasks) {
    EXPECT_TRUE(soften_edge(Image<Rgba8>(), Image<std::uint8_t>(), 2).alpha.empty());
    const SoftEdge none = soften_edge(draw_grain().photo, Image<std::uint8_t>(kSide_px, kSide_px), 2);
    EXPECT_EQ(none.alpha(kSide_px / 2, kSide_px / 2), 0);
}

}  // namespace
}  // namespace rs::capture
