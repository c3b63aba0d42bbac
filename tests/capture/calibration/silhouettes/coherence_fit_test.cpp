#include "capture/calibration/silhouettes/coherence_fit.hpp"

#include "rayspace/base/conventions.hpp"
#include "tests/capture/calibration/drawn_figure.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kCoherentViews = 24;

// Drift around the turn, 1 for 1 degree.
double drift_rad(double angle) {
    return radians(0.5 * std::sin(angle) + 0.4 * std::cos(2 * angle));
}

TurntableModel drifted(TurntableModel model) {
    for (std::size_t i = 1; i < model.angles_rad.size(); ++i) {
        model.angles_rad[i] += drift_rad(model.angles_rad[i]) - drift_rad(0);
    }
    model.pose.tilt_rad += radians(0.15);
    return model;
}

struct Known {
    ParameterIndices places;
    Eigen::MatrixXd covariance;
};

// Covariance from short tracks: steps are accurate, their sums are not.
Known known_by_short_tracks(const TurntableModel& model) {
    BundleFreedom free;
    free.k1 = true;
    ParameterIndices places(free, std::vector<bool>(model.angles_rad.size(), true));
    Eigen::VectorXd deviation = Eigen::VectorXd::Constant(places.count, radians(0.03));
    deviation(places.camera[0]) = 0.01 * model.lens.f_px;
    deviation(places.camera[3]) = 0.02;
    for (std::size_t k = CameraParameter::kPan; k < kCameraParameters; ++k) deviation(places.camera[k]) = radians(0.1);
    Eigen::MatrixXd covariance = deviation.cwiseAbs2().asDiagonal();
    for (const int harmonic : {1, 2}) {
        for (const double phase : {0.0, kPi / 2}) {
            Eigen::VectorXd along = Eigen::VectorXd::Zero(places.count);
            for (std::size_t i = 1; i < model.angles_rad.size(); ++i) {
                along(places.angles[i]) = radians(0.5) * std::cos(harmonic * model.angles_rad[i] + phase);
            }
            covariance += along * along.transpose();
        }
    }
    return {places, covariance};
}

// Error without a common rotation.
double angles_error_rad(const TurntableModel& found, const TurntableModel& truth) {
    const auto n = static_cast<double>(truth.angles_rad.size());
    double mean = 0, square = 0;
    for (std::size_t i = 0; i < truth.angles_rad.size(); ++i) {
        const double off = found.angles_rad[i] - truth.angles_rad[i];
        mean += off / n;
        square += off * off / n;
    }
    return std::sqrt(square - mean * mean);
}

SilhouetteTurn turn_of(const std::vector<Image<std::uint8_t>>& masks) {
    auto turn = SilhouetteTurn::create(masks, {600, 100});
    EXPECT_TRUE(turn.ok());
    return std::move(*turn);
}

std::vector<Image<std::uint8_t>> masks_of_figure() {
    return drawn(figure(), turn_of_figure(kCoherentViews));
}

TEST(CoherenceFit, MendsAnglesThatDriftAroundTheTurn) {
    const TurntableModel truth = turn_of_figure(kCoherentViews);
    const TurntableModel start = drifted(truth);
    const auto [places, covariance] = known_by_short_tracks(start);
    const SilhouetteTurn turn = turn_of(masks_of_figure());
    const auto fit = fit_coherence(start, places, covariance, turn, turn.reduction(), {});
    ASSERT_TRUE(fit.has_value());
    EXPECT_GT(angles_error_rad(start, truth), radians(0.4));
    EXPECT_LT(angles_error_rad(fit->model, truth), radians(0.15));
    EXPECT_LT(fit->consistency_residual_px, 0.2);
    // The deviations decrease, and still cover the error.
    double variance = 0, before = 0;
    for (const int place : places.angles) {
        if (place < 0) continue;
        variance += fit->covariance(place, place) / kCoherentViews;
        before += covariance(place, place) / kCoherentViews;
    }
    EXPECT_LT(variance, 0.8 * before);
    EXPECT_GT(2 * std::sqrt(variance), angles_error_rad(fit->model, truth));
}

TEST(CoherenceFit, IsTheSameOnAnyNumberOfThreads) {
    const TurntableModel start = drifted(turn_of_figure(kCoherentViews));
    const auto [places, covariance] = known_by_short_tracks(start);
    const SilhouetteTurn turn = turn_of(masks_of_figure());
    const auto many = fit_coherence(start, places, covariance, turn, turn.reduction(), {});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto alone = fit_coherence(start, places, covariance, turn, turn.reduction(), {});
    ASSERT_TRUE(many && alone);
    EXPECT_EQ(many->model.angles_rad, alone->model.angles_rad);
    EXPECT_EQ(many->model.lens.f_px, alone->model.lens.f_px);
}

// A body of revolution looks the same at any angle; neither angles nor lens may change.
TEST(CoherenceFit, RejectsABodyOfRevolution) {
    const TurntableModel truth = turn_of_figure(kCoherentViews);
    const auto [places, covariance] = known_by_short_tracks(truth);
    const SilhouetteTurn turn = turn_of(drawn(bottle(), truth));
    EXPECT_FALSE(fit_coherence(truth, places, covariance, turn, turn.reduction(), {}).has_value());
    const SilhouetteTurn of_figure = turn_of(masks_of_figure());
    EXPECT_TRUE(fit_coherence(truth, places, covariance, of_figure, of_figure.reduction(), {}).has_value());
}

TEST(CoherenceFit, AnglesThatAreHeldStay) {
    const TurntableModel truth = turn_of_figure(kCoherentViews);
    BundleFreedom free;
    free.angles = AngleFreedom::kConstant;
    const ParameterIndices places(free, std::vector<bool>(truth.angles_rad.size(), true));
    const Eigen::MatrixXd covariance = 1e-4 * Eigen::MatrixXd::Identity(places.count, places.count);
    const SilhouetteTurn turn = turn_of(masks_of_figure());
    EXPECT_FALSE(fit_coherence(truth, places, covariance, turn, turn.reduction(), {}).has_value());
}

TEST(CoherenceFit, RejectsInconsistentSilhouettes) {
    const TurntableModel truth = turn_of_figure(kCoherentViews);
    const auto [places, covariance] = known_by_short_tracks(truth);
    std::vector<Image<std::uint8_t>> masks = masks_of_figure();
    std::rotate(masks.begin(), masks.begin() + 7, masks.begin() + 15);
    const SilhouetteTurn turn = turn_of(masks);
    EXPECT_FALSE(fit_coherence(truth, places, covariance, turn, turn.reduction(), {}).has_value());
    EXPECT_FALSE(fit_coherence(truth, places, {}, turn, turn.reduction(), {.worst_px = 1e6}).has_value());
}

}  // namespace
}  // namespace rs::capture
