#include "capture/photos/soft_edge.hpp"

#include "tests/capture/photos/turn_of_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

Grain draw_grain() {
    Grain drawn;
    std::minstd_rand random(1);
    std::normal_distribution<double> noise(0, 6);
    for (int y = 0; y < kSide_px; ++y) {
        for (int x = 0; x < kSide_px; ++x) {
            const double alpha = std::clamp(distance_inside(x, y) + 0.5, 0.0, 1.0);
            const auto code = [](double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)); };
            const double dark = (x / 3 + y / 5) % 2 == 0 ? -22 : 22;
            const double behind = 165 + noise(random);
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
    EXPECT_LT(wrong.absolute, 0.035);
    EXPECT_LT(std::abs(wrong.signed_mean), 0.022);
}

TEST(SoftenEdge, MendsAMaskThatLiesOutside) {
    const Wrong wrong = wrong_in_band(draw_grain(), 1);
    EXPECT_LT(wrong.absolute, 0.04);
    EXPECT_LT(wrong.signed_mean, 0.03);
}

TEST(SoftenEdge, TakesEmptyPicturesAndMasks) {
    EXPECT_TRUE(soften_edge(Image<Rgba8>(), Image<std::uint8_t>(), 2).alpha.empty());
    const SoftEdge none = soften_edge(draw_grain().photo, Image<std::uint8_t>(kSide_px, kSide_px), 2);
    EXPECT_EQ(none.alpha(kSide_px / 2, kSide_px / 2), 0);
}

}  // namespace
}  // namespace rs::capture
