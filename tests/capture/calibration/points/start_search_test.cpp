#include "capture/calibration/points/bundle.hpp"

#include "rayspace/base/conventions.hpp"
#include "tests/capture/calibration/point_turns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace rs::capture {
namespace {

constexpr double kNoise_px = 0.5;

Lens middle_lens(const TurntableModel& truth) {
    return {truth.lens.width, truth.lens.height, 0, truth.lens.width / 2.0, truth.lens.height / 2.0, 0, 0};
}

// A share of the observations is at random positions: wrong matches.
std::vector<Track> noisy_tracks(const TurntableModel& truth, double wrong, std::uint32_t seed) {
    std::vector<Track> tracks = test::tracks_of(truth, test::surface_points(55, seed), kNoise_px, seed);
    std::mt19937 random(seed + 1000);
    std::uniform_real_distribution<double> share(0, 1);
    for (Track& track : tracks) {
        for (Observation& seen : track.seen) {
            const double chance = share(random), x = share(random), y = share(random);
            if (chance < wrong) seen.p = {200 + 600 * x, 150 + 500 * y};
        }
    }
    return tracks;
}

std::optional<InitialModel> start_of(const TurntableModel& truth, const KnownInputs& known = {}, double wrong = 0.1) {
    const std::vector<Track> tracks = noisy_tracks(truth, wrong, 21);
    return find_initial_model(tracks, test::pairs_of(tracks), static_cast<int>(truth.angles_rad.size()),
                              middle_lens(truth), known);
}

// A sideways axis has no upper end: both models give the same images.
TurntableModel seen_from_above(TurntableModel model) {
    if (model.pose.tilt_rad > 0) return model;
    model.pose = {-model.pose.pan_rad, -model.pose.tilt_rad,
                  model.pose.roll_rad + (model.pose.roll_rad > 0 ? -kPi : kPi)};
    for (double& angle : model.angles_rad) angle = -angle;
    return model;
}

// Accurate enough for the following bundle.
void expect_good_start(const std::optional<InitialModel>& start, const TurntableModel& truth, double step_rad) {
    ASSERT_TRUE(start.has_value());
    const TurntableModel found = seen_from_above(start->model);
    ASSERT_EQ(found.angles_rad.size(), truth.angles_rad.size());
    EXPECT_NEAR(degrees(found.angles_rad[1]), degrees(step_rad), 0.01 * std::abs(degrees(step_rad)));
    EXPECT_NEAR(degrees(found.pose.tilt_rad), degrees(truth.pose.tilt_rad), 4);
    EXPECT_NEAR(degrees(found.pose.roll_rad), degrees(truth.pose.roll_rad), 1);
    EXPECT_NEAR(found.lens.f_px, truth.lens.f_px, 0.15 * truth.lens.f_px);
    EXPECT_GT(start->agreeing, 180);
}

class SensesAndCounts : public testing::TestWithParam<double> {};

TEST_P(SensesAndCounts, AreFoundAmongWrongMatches) {
    const double step_rad = GetParam();
    // 36 photos for any step: with 360 / 35 degrees, the last one repeats the first.
    const TurntableModel truth = test::turn_model(36, step_rad);
    const auto start = start_of(truth);
    expect_good_start(start, truth, step_rad);
    EXPECT_GT(2 * start->agreeing, 3 * start->agreeing_opposite);
}

INSTANTIATE_TEST_SUITE_P(Turns, SensesAndCounts,
                         testing::Values(2 * kPi / 36, -2 * kPi / 36, 2 * kPi / 35, -2 * kPi / 35));

TEST(StartSearch, TakesTurnsOfOtherNumbersOfViews) {
    for (const int views : {35, 18, 48}) {
        const double step_rad = -2 * kPi / views;
        const TurntableModel truth = test::turn_model(views, step_rad);
        expect_good_start(start_of(truth), truth, step_rad);
    }
}

TEST(StartSearch, FindsAnAxisOnItsSide) {
    for (const double roll_deg : {89.0, -89.0}) {
        const TurntableModel truth = test::turn_model(36, radians(10), radians(roll_deg));
        expect_good_start(start_of(truth), truth, radians(10));
    }
}

TEST(StartSearch, BearsUnequalSteps) {
    TurntableModel truth = test::turn_model(36, -radians(10));
    std::mt19937 random(4);
    std::normal_distribution<double> unsteady(0, radians(0.8));
    for (std::size_t i = 1; i < 36; ++i) truth.angles_rad[i] += unsteady(random);
    for (std::size_t i = 20; i < 36; ++i) truth.angles_rad[i] -= radians(5);  // one step is half as long again
    const auto start = start_of(truth);
    ASSERT_TRUE(start.has_value());
    EXPECT_NEAR(degrees(start->model.angles_rad[1]), -10, 0.4);
    EXPECT_NEAR(degrees(start->model.pose.tilt_rad), 20, 6);
    EXPECT_NEAR(start->model.lens.f_px, truth.lens.f_px, 0.3 * truth.lens.f_px);
    for (std::size_t i = 0; i < 36; ++i) {
        EXPECT_NEAR(degrees(start->model.angles_rad[i]), degrees(truth.angles_rad[i]), 6) << i;
    }
}

TEST(StartSearch, HoldsWhatIsKnown) {
    const TurntableModel truth = test::turn_model(24, radians(7.5));  // half a turn
    KnownInputs known;
    known.f_px = 1700;
    known.step_rad = -radians(7.5);  // only its absolute value is used
    const auto start = start_of(truth, known);
    ASSERT_TRUE(start.has_value());
    EXPECT_EQ(start->model.lens.f_px, 1700);
    EXPECT_NEAR(start->model.angles_rad[5], truth.angles_rad[5], 1e-12);

    known.counter_clockwise = false;  // contradicts the images
    const auto forced = start_of(truth, known);
    if (forced) {
        EXPECT_LT(forced->model.angles_rad[1], 0);
        EXPECT_EQ(forced->agreeing_opposite, 0);
        EXPECT_LT(forced->agreeing, start->agreeing);
    }
    KnownInputs all;
    all.f_px = truth.lens.f_px;
    all.pose = truth.pose;
    all.angles_rad = truth.angles_rad;
    all.counter_clockwise = true;
    const auto given = start_of(truth, all);
    ASSERT_TRUE(given.has_value());
    EXPECT_EQ(given->model.angles_rad, truth.angles_rad);
    EXPECT_EQ(given->model.pose.tilt_rad, truth.pose.tilt_rad);
}

TEST(StartSearch, PointsThatGoAnywhereHaveNone) {
    const auto start = start_of(test::turn_model(24, radians(15)), {}, 1.0);
    if (start) {
        EXPECT_LT(start->agreeing, 60);
    }
    EXPECT_FALSE(find_initial_model({}, {}, 24, middle_lens(test::turn_model(24, radians(15))), {}).has_value());
}

}  // namespace
}  // namespace rs::capture
