#include "capture/photos/rig/turning.hpp"

#include "rayspace/base/conventions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::capture {
namespace {

constexpr int kTurning_views = 36;
constexpr double kStep_rad = 2 * kPi / kTurning_views;
constexpr double kDiscRadius_px = 90;
constexpr double kHeight_px = 130;
constexpr double kAxis_px = 120;

// An upright textured cylinder at a large distance, from `elevation_deg` above. Nearer points are lower in the image.
Image<Rgba8> cylinder(double turned_rad, double elevation_deg, double contrast) {
    const double e = radians(elevation_deg);
    Image<Rgba8> image(240, 220);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const double across = (x + 0.5 - kAxis_px) / kDiscRadius_px;
            if (std::abs(across) >= 1) continue;
            const double azimuth = std::asin(across);  // 0 is the front, growing to the right
            const double towards = kDiscRadius_px * std::cos(azimuth);
            const double up = (185 - (y + 0.5) + towards * std::sin(e)) / std::cos(e);
            if (up < 0 || up > kHeight_px) continue;
            const double t = azimuth - turned_rad;
            const double texture =
                std::sin(11 * t + 0.07 * up) * std::sin(0.21 * up - 5 * t) + std::sin(23 * t) * std::cos(0.16 * up);
            const auto code = static_cast<std::uint8_t>(128 + contrast * texture / 2);
            image(x, y) = {code, code, code, 255};
        }
    }
    return image;
}

// `sense` +1: the texture moves to the right on the front.
std::vector<Image<Rgba8>> turn(double sense, double elevation_deg, double contrast = 120, double step_rad = kStep_rad) {
    std::vector<Image<Rgba8>> views;
    for (int i = 0; i < kTurning_views; ++i) views.push_back(cylinder(sense * step_rad * i, elevation_deg, contrast));
    return views;
}

TEST(FindTurning, ReadsBothSensesFromAboveAndFromTheSide) {
    for (const double elevation_deg : {0.0, 12.0}) {
        EXPECT_EQ(find_turning(turn(-1, elevation_deg), kAxis_px, kDiscRadius_px, kStep_rad, true).turning,
                  Turning::kClockwise);
        EXPECT_EQ(find_turning(turn(1, elevation_deg), kAxis_px, kDiscRadius_px, kStep_rad, true).turning,
                  Turning::kCounterClockwise);
    }
}

TEST(FindTurning, WhatComesNearerSinks) {
    const TurningEvidence evidence = find_turning(turn(-1, 12), kAxis_px, kDiscRadius_px, kStep_rad, true);
    // A point at x approaches the camera by x times the step; sin(12 degrees) of that is downward motion.
    EXPECT_NEAR(evidence.sink_slope, radians(360.0 / kTurning_views) * std::sin(radians(12)), 0.01);
    EXPECT_GT(evidence.sink_slope, 8 * evidence.sink_slope_error);
}

// The search range depends on the step, not on the number of views. Repetitive texture is matched at wrong positions if
// the range is too large, and not matched at all if it is too small.
TEST(FindTurning, SearchesAsFarAsAStepOfAPartOfATurnGoes) {
    const double step_rad = radians(5);
    std::vector<Image<Rgba8>> views = turn(-1, 12, 120, step_rad);
    views.resize(8);
    const TurningEvidence evidence = find_turning(views, kAxis_px, kDiscRadius_px, step_rad, false);
    EXPECT_EQ(evidence.turning, Turning::kClockwise);
    EXPECT_EQ(evidence.front_right, 0);
    EXPECT_NEAR(evidence.sink_slope, step_rad * std::sin(radians(12)), 0.002);
}

TEST(FindTurning, SearchesAsFarAsAStepOfTwoTurnsGoes) {
    const double step_rad = 2 * kStep_rad;
    const TurningEvidence evidence =
        find_turning(turn(-1, 12, 120, step_rad), kAxis_px, kDiscRadius_px, step_rad, true);
    EXPECT_EQ(evidence.turning, Turning::kClockwise);
    EXPECT_EQ(evidence.front_right, 0);
    EXPECT_GT(evidence.front_left, 1000);
}

TEST(FindTurning, DecidesNothingWithoutTexture) {
    EXPECT_FALSE(find_turning(turn(-1, 12, 4), kAxis_px, kDiscRadius_px, kStep_rad, true).turning.has_value());
    EXPECT_FALSE(find_turning({}, kAxis_px, kDiscRadius_px, kStep_rad, true).turning.has_value());
}

}  // namespace
}  // namespace rs::capture
