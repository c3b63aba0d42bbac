#include "capture/calibration/points/bundle.hpp"

#include "rayspace/base/conventions.hpp"
#include "tests/capture/calibration/point_turns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rs::capture {
namespace {

BundleOptions all_free() {
    BundleOptions options;
    options.free.k1 = true;
    return options;
}

double worst_angle_error(const TurntableModel& found, const TurntableModel& truth) {
    double worst = 0;
    for (std::size_t i = 0; i < truth.angles_rad.size(); ++i) {
        worst = std::max(worst, std::abs(found.angles_rad[i] - truth.angles_rad[i]));
    }
    return worst;
}

TurntableModel uneven_turn() {
    TurntableModel truth = test::turn_model(36, radians(10));
    for (std::size_t i = 1; i < truth.angles_rad.size(); ++i) {
        truth.angles_rad[i] += 0.02 * std::sin(3.1 * static_cast<double>(i));
    }
    return truth;
}

TEST(Bundle, RecoversTheModelOfExactPoints) {
    const TurntableModel truth = uneven_turn();
    const auto tracks = test::tracks_of(truth, test::surface_points(120, 1), 0, 1);
    Bundle bundle = make_bundle(test::disturbed(truth), tracks);
    ASSERT_GT(bundle.tracks.size(), 100U);
    BundleOptions options = all_free();
    options.loss_px = 0.01;  // weight of the priors is proportional to it
    Bundle rough = bundle;
    ASSERT_TRUE(adjust(rough, all_free()).has_value());
    bundle = rough;
    options.max_iterations = 200;
    ASSERT_TRUE(adjust(bundle, options).has_value());
    EXPECT_LT(rms_px(bundle), 0.002);
    EXPECT_NEAR(bundle.model.lens.f_px, truth.lens.f_px, 0.2);
    EXPECT_NEAR(bundle.model.lens.k1, truth.lens.k1, 1e-3);
    EXPECT_NEAR(bundle.model.pose.pan_rad, truth.pose.pan_rad, 1e-5);
    EXPECT_NEAR(bundle.model.pose.tilt_rad, truth.pose.tilt_rad, 1e-4);
    EXPECT_NEAR(bundle.model.pose.roll_rad, truth.pose.roll_rad, 1e-5);
    EXPECT_LT(worst_angle_error(bundle.model, truth), 1e-4);
    EXPECT_EQ(bundle.model.angles_rad[0], 0);
}

TEST(Bundle, StaysNearTheTruthWithNoise) {
    const TurntableModel truth = uneven_turn();
    const auto tracks = test::tracks_of(truth, test::surface_points(200, 2), 0.3, 2);
    Bundle bundle = make_bundle(test::disturbed(truth), tracks);
    ASSERT_TRUE(adjust(bundle, all_free()).has_value());
    EXPECT_NEAR(bundle.model.lens.f_px, truth.lens.f_px, 0.02 * truth.lens.f_px);
    EXPECT_NEAR(bundle.model.pose.tilt_rad, truth.pose.tilt_rad, radians(0.5));
    EXPECT_NEAR(bundle.model.pose.roll_rad, truth.pose.roll_rad, radians(0.05));
    EXPECT_LT(worst_angle_error(bundle.model, truth), radians(0.1));
    // sigma sqrt(2) for two components, minus the degrees of freedom of the fit.
    EXPECT_NEAR(rms_px(bundle), 0.3 * std::sqrt(2.0), 0.04);
    EXPECT_NEAR(robust_deviation_px(bundle), 0.3, 0.03);
}

TEST(Bundle, HoldsWhatIsNotFree) {
    const TurntableModel truth = uneven_turn();
    const auto tracks = test::tracks_of(truth, test::surface_points(80, 3), 0.2, 3);
    TurntableModel start = truth;
    start.lens.f_px = 1650;
    start.pose.roll_rad = 0.015;
    Bundle bundle = make_bundle(start, tracks);
    BundleOptions options;
    options.free.f = options.free.roll = false;
    options.free.angles = AngleFreedom::kConstant;
    ASSERT_TRUE(adjust(bundle, options).has_value());
    EXPECT_EQ(bundle.model.lens.f_px, 1650);
    EXPECT_EQ(bundle.model.pose.roll_rad, 0.015);
    EXPECT_EQ(bundle.model.angles_rad, truth.angles_rad);
    EXPECT_EQ(bundle.model.lens.k1, truth.lens.k1);
    EXPECT_NE(bundle.model.pose.tilt_rad, truth.pose.tilt_rad);
}

TEST(Bundle, FindsOneCommonStep) {
    const TurntableModel truth = test::turn_model(36, -2 * kPi / 35);
    const auto tracks = test::tracks_of(truth, test::surface_points(120, 4), 0.2, 4);
    TurntableModel start = test::turn_model(36, -radians(10));
    Bundle bundle = make_bundle(start, tracks);
    BundleOptions options = all_free();
    options.free.angles = AngleFreedom::kCommonStep;
    ASSERT_TRUE(adjust(bundle, options).has_value());
    for (std::size_t i = 0; i < 36; ++i) {
        EXPECT_NEAR(bundle.model.angles_rad[i], truth.angles_rad[i], radians(0.003 * static_cast<double>(i)) + 1e-12);
    }
}

TEST(Bundle, ItsCostIsThatOfWeightedResiduals) {
    const TurntableModel truth = test::turn_model(12, radians(30));
    auto tracks = test::tracks_of(truth, test::surface_points(120, 5), 0.3, 5);
    for (Track& track : tracks) {
        for (Observation& seen : track.seen) seen.weight = {{0.5, 0.1}, {0.1, 2}};
    }
    TurntableModel start = truth;
    start.pose.pan_rad += 0.002;
    start.lens.k1 = 0;  // constant, and equal to its prior
    Bundle bundle = make_bundle(start, tracks);
    const BundleOptions options;
    const auto by_hand = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
            for (const Observation& seen : bundle.tracks[i].seen) {
                const glm::dvec2 r = seen.weight * residual(bundle.model, bundle.points[i], seen).value();
                sum += options.loss_px * options.loss_px * std::log1p(glm::dot(r, r) / std::pow(options.loss_px, 2));
            }
        }
        return sum / observation_count(bundle);
    };
    const double before = by_hand();
    const auto after = adjust(bundle, options);
    ASSERT_TRUE(after.has_value());
    EXPECT_LT(*after, 0.9 * before);
    EXPECT_NEAR(*after, by_hand(), 1e-9);
}

TEST(Bundle, NoLensIsTooShortToBeSoughtButOneMayBeKnown) {
    const TurntableModel truth = test::turn_model(12, radians(30));
    TurntableModel start = truth;
    start.lens.f_px = 99;  // for an image 1000 px wide
    Bundle bundle = make_bundle(truth, test::tracks_of(truth, test::surface_points(60, 6), 0.3, 6));
    bundle.model = start;
    Bundle known = bundle;
    EXPECT_FALSE(adjust(bundle, {}).has_value());
    BundleOptions options;
    options.free.f = false;
    EXPECT_TRUE(adjust(known, options).has_value());
    EXPECT_EQ(known.model.lens.f_px, 99);
}

TEST(Bundle, NothingToAdjustIsNoSolution) {
    Bundle empty{test::turn_model(12, radians(30)), {}, {}};
    EXPECT_FALSE(adjust(empty, {}).has_value());
    EXPECT_EQ(rms_px(empty), 0);
    EXPECT_EQ(robust_deviation_px(empty), 0);
}

TEST(Bundle, TriangulatesOnlyWhatRaysDetermine) {
    const TurntableModel model = test::turn_model(36, radians(10));
    const auto points = test::surface_points(20, 5);
    const auto tracks = test::tracks_of(model, points, 0, 5);
    ASSERT_EQ(tracks.size(), points.size());
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        const auto p = triangulate(model, tracks[i]);
        ASSERT_TRUE(p.has_value());
        EXPECT_LT(glm::distance(*p, points[i].p), 1e-6);
    }
    EXPECT_FALSE(triangulate(model, Track{{tracks[0].seen[0]}}).has_value());
}

TEST(Bundle, DropsOutliersAndWhatTheyLeaveTooShort) {
    const TurntableModel model = test::turn_model(36, radians(10));
    const auto clean = test::tracks_of(model, test::surface_points(30, 6), 0, 6);
    Bundle bundle = make_bundle(model, clean);
    ASSERT_EQ(bundle.tracks.size(), 30U);
    const int before = observation_count(bundle);
    EXPECT_EQ(drop_outliers(bundle, 0.5), 0);

    bundle.tracks[4].seen[2].p.x += 3;  // one of many observations
    bundle.tracks[7].seen.resize(3);    // one of three: two are too few for a track
    bundle.tracks[7].seen[1].p.y -= 3;
    bundle.tracks[9].seen[0].p.x += 3;  // low weight, so it stays
    bundle.tracks[9].seen[0].weight = glm::dmat2(0.1);
    const int lost_by_cutting = static_cast<int>(clean[7].seen.size()) - 3;
    EXPECT_EQ(drop_outliers(bundle, 0.5), 2);
    EXPECT_EQ(bundle.tracks.size(), 29U);
    EXPECT_EQ(bundle.points.size(), 29U);
    EXPECT_EQ(observation_count(bundle), before - lost_by_cutting - 1 - 3);
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        for (const Observation& seen : bundle.tracks[i].seen) {
            EXPECT_LE(glm::length(seen.weight * residual(model, bundle.points[i], seen).value()), 0.5);
        }
    }
}

TEST(Bundle, KeepsTheObservationsThatAgree) {
    const TurntableModel model = test::turn_model(36, radians(10));
    const auto clean = test::tracks_of(model, test::surface_points(40, 7), 0.1, 7);
    auto tracks = clean;
    int wrong = 0;
    for (std::size_t i = 0; i < tracks.size(); i += 2) {  // a third of every other track is wrong
        for (std::size_t k = 1; k < tracks[i].seen.size(); k += 3, ++wrong) {
            tracks[i].seen[k].p += glm::dvec2(25 + 5 * static_cast<double>(k), -30);
        }
    }
    const Bundle bundle = make_robust_bundle(model, tracks, 2);
    ASSERT_EQ(bundle.tracks.size(), tracks.size());
    EXPECT_EQ(observation_count(bundle), observation_count(make_bundle(model, clean)) - wrong);
    EXPECT_LT(rms_px(bundle), 0.2);

    Track nonsense;  // no three observations agree on a point
    for (int k = 0; k < 4; ++k)
        nonsense.seen.push_back({k, {100.0 + 200 * k, k % 2 == 0 ? 100 : 700}, glm::dmat2(1.0)});
    EXPECT_TRUE(make_robust_bundle(model, std::vector<Track>{nonsense}, 2).tracks.empty());
}

TEST(Bundle, CountsObservationsOfEachView) {
    const std::vector<Track> tracks{{{{0, {}, glm::dmat2(1.0)}, {2, {}, glm::dmat2(1.0)}}},
                                    {{{2, {}, glm::dmat2(1.0)}, {3, {}, glm::dmat2(1.0)}}}};
    EXPECT_EQ(observations_per_view(tracks, 5), (std::vector<int>{1, 0, 2, 1, 0}));
}

}  // namespace
}  // namespace rs::capture
