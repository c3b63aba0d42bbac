// Camera and angles from common tangent planes of two silhouettes, for a point cloud with a known turn. The hull of a
// cloud is a polyhedron, and tangent planes touch it at vertices, so the true model has no residual.

#include "capture/calibration/silhouettes/silhouette_tangency.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/median.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kTangencyViews = 36;

TurntableModel turn_of_cloud() {
    TurntableModel model;
    model.lens = {720, 576, 1008, 360, 288, -0.12, 0};
    model.pose = {0.02, radians(20), 0.01};
    for (int i = 0; i < kTangencyViews; ++i) model.angles_rad.push_back(2 * kPi * i / kTangencyViews);
    return model;
}

std::vector<glm::dvec3> cloud() {
    std::mt19937 random(5);
    const auto number = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
    };
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 60; ++i) {
        points.emplace_back(number(-0.14, 0.18), number(-0.45, -0.22), number(-0.17, 0.12));
    }
    return points;
}

// Projections of all points of the cloud into each view: their hull is that of the silhouette.
std::vector<SilhouetteHull> hulls_of_cloud(const TurntableModel& model, double noise_px) {
    std::mt19937 random(7);
    const auto noise = [&] {
        return noise_px * (2 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 1);
    };
    std::vector<SilhouetteHull> hulls;
    for (const double angle : model.angles_rad) {
        SilhouetteHull hull;
        for (const glm::dvec3& p : cloud()) {
            const auto seen = project(model.lens, model.pose, turned(p, angle));
            EXPECT_TRUE(seen.has_value());
            if (seen) hull.push_back(*seen + glm::dvec2(noise(), noise()));
        }
        hulls.push_back(hull);
    }
    return hulls;
}

double largest(const std::vector<double>& values) {
    double most = 0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
}

ParameterIndices all_places() {
    BundleFreedom free;
    free.k1 = true;
    return {free, std::vector<bool>(kTangencyViews, true)};
}

// Covariance of typical tracks: f to 1 %, k1 to 0.05, directions to 0.1 degrees, angles to 0.2 degrees each.
Eigen::MatrixXd roughly_known(const ParameterIndices& places, const TurntableModel& model) {
    Eigen::VectorXd deviation = Eigen::VectorXd::Constant(places.count, radians(0.2));
    deviation(places.camera[0]) = 0.01 * model.lens.f_px;
    deviation(places.camera[3]) = 0.05;
    for (std::size_t k = CameraParameter::kPan; k < kCameraParameters; ++k) deviation(places.camera[k]) = radians(0.1);
    return deviation.cwiseAbs2().asDiagonal();
}

TEST(SilhouetteTangency, TruthLeavesNoResidual) {
    const TurntableModel truth = turn_of_cloud();
    const auto hulls = hulls_of_cloud(truth, 0);
    const auto pairs = comparable_views(truth, hulls);
    EXPECT_GT(pairs.size(), 400U);
    EXPECT_LT(largest(tangency_residuals(truth, hulls, pairs)), 1e-6);
    TurntableModel longer = truth;
    longer.lens.f_px *= 1.02;
    EXPECT_GT(largest(tangency_residuals(longer, hulls, pairs)), 0.1);
}

TEST(SilhouetteTangency, FitMendsFocalLengthAndAnglesThatDrift) {
    const TurntableModel truth = turn_of_cloud();
    TurntableModel start = truth;
    start.lens.f_px *= 1.012;
    start.pose.tilt_rad += radians(0.06);
    for (double& angle : start.angles_rad) angle += radians(0.15) * std::sin(angle);
    const auto hulls = hulls_of_cloud(truth, 0.05);
    const ParameterIndices places = all_places();
    const auto fit = fit_tangency(start, places, roughly_known(places, start), hulls, 0.3);
    ASSERT_TRUE(fit.has_value());
    EXPECT_NEAR(fit->model.lens.f_px / truth.lens.f_px, 1, 0.003);
    EXPECT_NEAR(fit->model.pose.tilt_rad, truth.pose.tilt_rad, radians(0.03));
    double error_sq = 0;
    for (std::size_t i = 0; i < truth.angles_rad.size(); ++i) {
        error_sq += std::pow(fit->model.angles_rad[i] - truth.angles_rad[i], 2) / kTangencyViews;
    }
    EXPECT_LT(std::sqrt(error_sq), radians(0.04));
    EXPECT_LT(fit->deviation_px, 0.1);
    const int f = places.camera[0];
    EXPECT_LT(fit->covariance(f, f), std::pow(0.01 * start.lens.f_px, 2));
    EXPECT_GT(3 * std::sqrt(fit->covariance(f, f)), std::abs(fit->model.lens.f_px - truth.lens.f_px));
}

// A start whose f and tilt are off by several deviations of roughly_known().
TurntableModel far_start(const TurntableModel& truth) {
    TurntableModel start = truth;
    start.lens.f_px *= 1.05;
    start.pose.tilt_rad += radians(0.3);
    return start;
}

TEST(SilhouetteTangency, WeighsSilhouettesByFinalResiduals) {
    const TurntableModel truth = turn_of_cloud();
    const TurntableModel start = far_start(truth);
    const auto hulls = hulls_of_cloud(truth, 0.05);
    constexpr double kWorst_px = 0.1;
    std::vector<double> before = tangency_residuals(start, hulls, comparable_views(start, hulls));
    for (double& residual : before) residual = std::abs(residual);
    EXPECT_GT(median(before), 2 * kWorst_px);
    const ParameterIndices places = all_places();
    const auto fit = fit_tangency(start, places, roughly_known(places, start), hulls, kWorst_px);
    ASSERT_TRUE(fit.has_value());
    EXPECT_LT(fit->deviation_px, kWorst_px);
    EXPECT_NEAR(fit->model.lens.f_px / truth.lens.f_px, 1, 0.005);
}

TEST(SilhouetteTangency, WhatClaimedTooMuchIsBelievedLess) {
    const TurntableModel truth = turn_of_cloud();
    const auto hulls = hulls_of_cloud(truth, 1);
    const ParameterIndices places = all_places();
    const auto known = roughly_known(places, truth);
    const auto near = fit_tangency(truth, places, known, hulls, 3);
    const auto far = fit_tangency(far_start(truth), places, known, hulls, 3);
    ASSERT_TRUE(near && far);
    const int f = places.camera[0], k1 = places.camera[3];
    EXPECT_GT(far->covariance(k1, k1), 2 * near->covariance(k1, k1));
    EXPECT_GT(2 * std::sqrt(far->covariance(f, f)), std::abs(far->model.lens.f_px - truth.lens.f_px));
}

TEST(SilhouetteTangency, RejectsInconsistentSilhouettes) {
    const TurntableModel truth = turn_of_cloud();
    const ParameterIndices places = all_places();
    const auto known = roughly_known(places, truth);
    EXPECT_FALSE(fit_tangency(truth, places, known, hulls_of_cloud(truth, 4), 0.3).has_value());
    EXPECT_TRUE(fit_tangency(truth, places, known, hulls_of_cloud(truth, 4), 30).has_value());
    const std::vector<SilhouetteHull> none(kTangencyViews);
    EXPECT_FALSE(fit_tangency(truth, places, known, none, 0.3).has_value());
}

TEST(SilhouetteTangency, HullsLieWhereAlphaIsHalf) {
    const TurntableModel model = turn_of_cloud();
    constexpr double kRadius_px = 40;
    const auto disc = [&](double x_px, double y_px) {
        CalibrationImage image{Image<std::uint8_t>(360, 288), Image<std::uint8_t>(360, 288)};
        for (int y = 0; y < 288; ++y) {
            for (int x = 0; x < 360; ++x) {
                const double inside = kRadius_px - std::hypot(x + 0.5 - x_px, y + 0.5 - y_px);
                image.alpha(x, y) = static_cast<std::uint8_t>(std::lround(255 * std::clamp(inside + 0.5, 0.0, 1.0)));
            }
        }
        return image;
    };
    std::vector<CalibrationImage> turn;
    turn.push_back(disc(180.3, 140.6));
    turn.push_back(disc(20, 140));  // cut off
    const auto hulls = silhouette_hulls(turn, 2, model);
    ASSERT_EQ(hulls.size(), 2U);
    ASSERT_GT(hulls[0].size(), 20U);
    for (const glm::dvec2& p : hulls[0]) EXPECT_NEAR(glm::distance(p, glm::dvec2(360.6, 281.2)), 2 * kRadius_px, 0.3);
    EXPECT_TRUE(hulls[1].empty());
}

}  // namespace
}  // namespace rs::capture
