// Stated deviations compared with the scatter of the estimates over repeated random noise.

#include "capture/calibration/points/model_covariance.hpp"

#include "rayspace/base/conventions.hpp"
#include "tests/capture/calibration/point_turns.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kDraws = 40;

// Root mean squares of the stated deviation and of the true error of one number.
struct Tally {
    double stated2 = 0;
    double off2 = 0;

    void add(double stated, double off) {
        stated2 += stated * stated;
        off2 += off * off;
    }
    [[nodiscard]] double ratio() const { return std::sqrt(stated2 / off2); }
};

struct DrawnErrors {
    double noise_px = 0;  // independent noise of every observation
    double side_px = 0;   // common shift of the points of every tenth of the turn
};

// Adds a common error to the tracks of each side of the object.
void shift_sides(std::vector<Track>& tracks, const TurntableModel& truth, double side_px, std::uint32_t seed) {
    constexpr int kSides = 10;
    std::mt19937 random(seed);
    std::normal_distribution<double> error(0, side_px);
    std::array<glm::dvec2, kSides> shift;
    for (glm::dvec2& each : shift) {
        each.x = error(random);
        each.y = error(random);
    }
    for (Track& track : tracks) {
        glm::dvec2 sum(0.0);
        for (const Observation& seen : track.seen) {
            const double angle = truth.angles_rad[static_cast<std::size_t>(seen.view)];
            sum += glm::dvec2(std::cos(angle), std::sin(angle));
        }
        const double middle = std::atan2(sum.y, sum.x);
        const auto side = static_cast<std::size_t>((middle / (2 * kPi) + 0.5) * kSides) % kSides;
        for (Observation& seen : track.seen) {
            seen.p += shift[side] * std::sin(truth.angles_rad[static_cast<std::size_t>(seen.view)] - middle);
        }
    }
}

// Constants have their true values at the start.
Bundle bundle_of_draw(const TurntableModel& truth, const BundleOptions& options, const DrawnErrors& errors,
                      std::uint32_t seed) {
    auto tracks = test::tracks_of(truth, test::surface_points(160, 11), errors.noise_px, seed);
    shift_sides(tracks, truth, errors.side_px, seed + 1000);
    Bundle bundle = make_bundle(truth, tracks);
    EXPECT_TRUE(adjust(bundle, options).has_value());
    return bundle;
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Checks the deviations of f, k1, tilt, roll, axis position and angles.
void expect_honest(const TurntableModel& truth, const BundleOptions& options, const DrawnErrors& errors) {
    Tally f, k1, tilt, roll, position, angles;
    const bool sideways = has_sideways_axis(truth.pose);
    const double at_px = 0.5 * (sideways ? truth.lens.width : truth.lens.height);
    const auto axis = [&](const TurntableModel& model) {
        return (sideways ? axis_row(model.lens, model.pose, at_px) : axis_column(model.lens, model.pose, at_px))
            .value();
    };
    for (int draw = 0; draw < kDraws; ++draw) {
        const Bundle bundle = bundle_of_draw(truth, options, errors, 100 + static_cast<std::uint32_t>(draw));
        const ModelDeviations stated = bundle_standard_deviations(bundle, options, at_px);
        const TurntableModel& found = bundle.model;
        f.add(stated.f_px, found.lens.f_px - truth.lens.f_px);
        if (options.free.k1) k1.add(stated.k1, found.lens.k1 - truth.lens.k1);
        tilt.add(stated.tilt_rad, found.pose.tilt_rad - truth.pose.tilt_rad);
        roll.add(stated.roll_rad, found.pose.roll_rad - truth.pose.roll_rad);
        position.add(stated.axis_position_px, axis(found) - axis(truth));
        ASSERT_EQ(stated.angles_rad.size(), truth.angles_rad.size());
        const double middle = mean(found.angles_rad) - mean(truth.angles_rad);
        for (std::size_t i = 0; i < truth.angles_rad.size(); ++i) {
            angles.add(stated.angles_rad[i], found.angles_rad[i] - truth.angles_rad[i] - middle);
        }
    }
    const auto expect_near_one = [](const Tally& tally, const std::string& number) {
        EXPECT_GT(tally.ratio(), 0.7) << number;
        EXPECT_LT(tally.ratio(), 1.4) << number;
    };
    expect_near_one(f, "f");
    if (options.free.k1) expect_near_one(k1, "k1");
    expect_near_one(tilt, "tilt");
    expect_near_one(roll, "roll");
    expect_near_one(position, "axis position");
    expect_near_one(angles, "angles");
}

TEST(BundleDeviations, AreWhatTheNoiseDoes) {
    BundleOptions options;
    options.free.k1 = true;
    options.loss_px = 0.6;
    expect_honest(test::turn_model(24, radians(15)), options, {.noise_px = 0.3});
}

TEST(BundleDeviations, AreSoForACommonStepAndAnAxisOnItsSide) {
    BundleOptions options;
    options.loss_px = 0.6;
    options.free.angles = AngleFreedom::kCommonStep;
    expect_honest(test::turn_model(24, -radians(15), radians(88)), options, {.noise_px = 0.3});
}

TEST(BundleDeviations, HoldWhatOneSideOfTheObjectHasInCommon) {
    BundleOptions options;
    options.free.k1 = true;
    options.loss_px = 0.6;
    expect_honest(test::turn_model(24, radians(15)), options, {.noise_px = 0.1, .side_px = 0.3});
}

TEST(BundleDeviations, WhatIsHeldHasNone) {
    const TurntableModel truth = test::turn_model(24, radians(15));
    BundleOptions options;
    options.free.f = options.free.tilt = false;
    options.free.angles = AngleFreedom::kConstant;
    const Bundle bundle = bundle_of_draw(truth, options, {.noise_px = 0.3}, 5);
    const ModelDeviations stated = bundle_standard_deviations(bundle, options, 400);
    EXPECT_EQ(stated.f_px, 0);
    EXPECT_EQ(stated.cx, 0);
    EXPECT_EQ(stated.k1, 0);
    EXPECT_EQ(stated.tilt_rad, 0);
    EXPECT_GT(stated.roll_rad, 0);
    EXPECT_LT(stated.roll_rad, radians(0.1));
    EXPECT_GT(stated.axis_position_px, 0);
    EXPECT_EQ(stated.angles_rad, std::vector<double>(24, 0.0));
}

TEST(BundleDeviations, AreInfiniteWhereTooLittleIsSeen) {
    const TurntableModel truth = test::turn_model(24, radians(15));
    Bundle bundle = bundle_of_draw(truth, {}, {.noise_px = 0.3}, 6);
    bundle.tracks.resize(8);  // for 27 unknowns
    bundle.points.resize(8);
    const ModelDeviations stated = bundle_standard_deviations(bundle, {}, 400);
    EXPECT_TRUE(std::isinf(stated.f_px));
    EXPECT_TRUE(std::isinf(stated.tilt_rad));
    EXPECT_TRUE(std::isinf(stated.axis_position_px));
    EXPECT_TRUE(std::isinf(stated.angles_rad[3]));
}

TEST(BundleDeviations, FallWithTheNoise) {
    const TurntableModel truth = test::turn_model(24, radians(15));
    BundleOptions loud, quiet;
    loud.loss_px = 0.8;
    quiet.loss_px = 0.2;
    const auto of = [&](const BundleOptions& options, double noise_px) {
        return bundle_standard_deviations(bundle_of_draw(truth, options, {.noise_px = noise_px}, 7), options, 400);
    };
    EXPECT_NEAR(of(loud, 0.4).f_px / of(quiet, 0.1).f_px, 4, 0.4);
}

}  // namespace
}  // namespace rs::capture
