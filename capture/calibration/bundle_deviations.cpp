#include "capture/calibration/bundle_deviations.hpp"

#include "capture/calibration/model_covariance.hpp"
#include "capture/calibration/projection.hpp"
#include "rayspace/conventions.hpp"

#include <ceres/autodiff_cost_function.h>
#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr std::size_t kSharedErrors = 4;

// Errors of one side of the object, per px of robust_deviation_px; and how many sides there are.
constexpr double kSectorError = 2;
constexpr std::size_t kSectors = 12;

// By how much a point may seem to move, per px of shared error, seen `beside_rad` from the middle of its views.
std::array<Eigen::Vector2d, kSharedErrors> shared_errors(double beside_rad) {
    const double odd = std::sin(beside_rad), even = 1 - std::cos(beside_rad);
    return {Eigen::Vector2d(odd, 0), Eigen::Vector2d(0, odd), Eigen::Vector2d(even, 0), Eigen::Vector2d(0, even)};
}

double middle_angle(const TurntableModel& model, const Track& track) {
    double sine = 0, cosine = 0;
    for (const Observation& seen : track.seen) {
        sine += std::sin(model.angles_rad[static_cast<std::size_t>(seen.view)]);
        cosine += std::cos(model.angles_rad[static_cast<std::size_t>(seen.view)]);
    }
    return std::atan2(sine, cosine);
}

// Which points are near each other: [point] a number of its neighbourhood, a sector around the axis in a band of
// height; made smaller until there are at least `fewest`, or each point is alone.
std::vector<std::size_t> neighbourhoods(const std::vector<glm::dvec3>& points, std::size_t fewest) {
    constexpr int kAround = 16, kBands = 6;
    constexpr int kFinest = 64;
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const glm::dvec3& p : points) {
        lowest = std::min(lowest, p.y);
        highest = std::max(highest, p.y);
    }
    const double height = std::max(highest - lowest, 1e-12);
    std::vector<std::size_t> result(points.size());
    for (int finer = 1; finer <= kFinest; finer *= 2) {
        std::map<std::pair<int, int>, std::size_t> numbers;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double around = std::atan2(points[i].x, points[i].z) / (2 * kPi) + 0.5;
            const std::pair<int, int> place{static_cast<int>(around * kAround * finer),
                                            static_cast<int>((points[i].y - lowest) / height * kBands * finer)};
            result[i] = numbers.try_emplace(place, numbers.size()).first->second;
        }
        if (numbers.size() >= fewest) return result;
    }
    for (std::size_t i = 0; i < points.size(); ++i) result[i] = i;
    return result;
}

}  // namespace

Eigen::MatrixXd bundle_covariance(const Bundle& bundle, const BundleOptions& options, double shared_error_px) {
    const TurntableModel& model = bundle.model;
    const NumberPlaces places(options.free, std::vector<bool>(model.angles_rad.size(), true));
    const std::array<double, 5> lens{model.lens.f_px, model.lens.cx, model.lens.cy, model.lens.k1, model.lens.k2};
    const std::array<double, 3> pose{model.pose.pan_rad, model.pose.tilt_rad, model.pose.roll_rad};
    const bool common = options.free.angles == AngleFreedom::kCommonStep;
    const int n = places.count;

    Eigen::MatrixXd bread = Eigen::MatrixXd::Zero(n, n);
    Eigen::MatrixXd meat;
    // What each shared error does to the score, for the tracks of each sector.
    std::vector<Eigen::MatrixXd> shared(kSectors, Eigen::MatrixXd::Zero(n, kSharedErrors));
    const std::vector<std::size_t> neighbourhood = neighbourhoods(bundle.points, 2 * static_cast<std::size_t>(n));
    Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(bundle.points.size()));
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        Eigen::MatrixXd camera_camera = Eigen::MatrixXd::Zero(n, n);
        Eigen::MatrixXd camera_point = Eigen::MatrixXd::Zero(n, 3);
        Eigen::Matrix3d point_point = Eigen::Matrix3d::Zero();
        Eigen::VectorXd camera_score = Eigen::VectorXd::Zero(n);
        Eigen::Vector3d point_score = Eigen::Vector3d::Zero();
        Eigen::MatrixXd camera_shared = Eigen::MatrixXd::Zero(n, kSharedErrors);
        Eigen::Matrix<double, 3, kSharedErrors> point_shared = Eigen::Matrix<double, 3, kSharedErrors>::Zero();
        const double middle_rad = middle_angle(model, bundle.tracks[i]);
        for (const Observation& seen : bundle.tracks[i].seen) {
            const auto view = static_cast<std::size_t>(seen.view);
            const double turns = common ? static_cast<double>(seen.view) : 1.0;
            const double angle =
                common ? (seen.view == 0 ? 0.0 : model.angles_rad[view] / turns) : model.angles_rad[view];
            const ceres::AutoDiffCostFunction<Reprojection, 2, 5, 3, 1, 3> cost(
                new Reprojection{seen.p.x, seen.p.y, turns, seen.weight[0][0], seen.weight[1][0], seen.weight[1][1]});
            const std::array<const double*, 4> blocks{lens.data(), pose.data(), &angle, &bundle.points[i].x};
            Eigen::Vector2d r;
            Eigen::Matrix<double, 2, 5, Eigen::RowMajor> by_lens;
            Eigen::Matrix<double, 2, 3, Eigen::RowMajor> by_pose, by_point;
            Eigen::Vector2d by_angle;
            std::array<double*, 4> jacobians{by_lens.data(), by_pose.data(), by_angle.data(), by_point.data()};
            if (!cost.Evaluate(blocks.data(), r.data(), jacobians.data())) continue;
            const double weight = 1 / (1 + r.squaredNorm() / (options.loss_px * options.loss_px));

            Eigen::Matrix2d whitening;
            whitening << seen.weight[0][0], seen.weight[1][0], seen.weight[0][1], seen.weight[1][1];
            Eigen::Matrix<double, 2, kSharedErrors> error;
            const auto movements = shared_errors(model.angles_rad[view] - middle_rad);
            for (std::size_t k = 0; k < kSharedErrors; ++k) {
                error.col(static_cast<Eigen::Index>(k)) = whitening * movements[k];
            }

            std::array<std::pair<int, Eigen::Vector2d>, kCameraNumbers + 1> columns;
            std::size_t used = 0;
            const auto add = [&](int place, const Eigen::Vector2d& slope) {
                if (place >= 0) columns[used++] = {place, slope};
            };
            for (int k = 0; k < 5; ++k) add(places.camera[static_cast<std::size_t>(k)], by_lens.col(k));
            for (int k = 0; k < 3; ++k) add(places.camera[static_cast<std::size_t>(5 + k)], by_pose.col(k));
            add(common ? places.step : places.angles[view], by_angle);
            for (std::size_t a = 0; a < used; ++a) {
                const auto& [place, slope] = columns[a];
                camera_score(place) += weight * slope.dot(r);
                camera_shared.row(place) += weight * slope.transpose() * error;
                camera_point.row(place) += weight * slope.transpose() * by_point;
                for (std::size_t b = 0; b < used; ++b) {
                    camera_camera(place, columns[b].first) += weight * slope.dot(columns[b].second);
                }
            }
            point_point += weight * by_point.transpose() * by_point;
            point_score += weight * by_point.transpose() * r;
            point_shared += weight * by_point.transpose() * error;
        }
        const Eigen::Matrix3d inverse = point_point.inverse();
        if (!inverse.allFinite()) continue;
        bread += camera_camera - camera_point * inverse * camera_point.transpose();
        const Eigen::VectorXd score = camera_score - camera_point * inverse * point_score;
        scores.col(static_cast<Eigen::Index>(neighbourhood[i])) += score;
        const double around = middle_rad / (2 * kPi) + 0.5;
        const auto sector = static_cast<std::size_t>(around * static_cast<double>(kSectors)) % kSectors;
        shared[sector] += camera_shared - camera_point * inverse * point_shared;
    }
    meat = scores * scores.transpose();
    const auto clusters = static_cast<int>((scores.colwise().squaredNorm().array() > 0).count());
    const std::array<double, 5> priors{0, kPriorPrincipalPoint * model.lens.width,
                                       kPriorPrincipalPoint * model.lens.width, kPriorK1, kPriorK2};
    for (std::size_t k = 1; k < priors.size(); ++k) {
        if (places.camera[k] < 0) continue;
        const double information = std::pow(options.loss_px / priors[k], 2);
        bread(places.camera[k], places.camera[k]) += information;
        meat(places.camera[k], places.camera[k]) += information * options.loss_px * options.loss_px;
    }

    if (clusters <= n) return {};
    const Eigen::LDLT<Eigen::MatrixXd> solver(bread);
    if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-15)) return {};
    const double few = static_cast<double>(clusters) / (clusters - n);  // the usual correction for few clusters
    const Eigen::MatrixXd half = solver.solve(meat);
    Eigen::MatrixXd covariance = few * solver.solve(half.transpose());
    const double sector_error_px = shared_error_px > 0 ? kSectorError * robust_deviation_px(bundle) : 0;
    Eigen::MatrixXd everywhere = Eigen::MatrixXd::Zero(n, kSharedErrors);
    for (const Eigen::MatrixXd& sector : shared) {
        everywhere += sector;
        const Eigen::MatrixXd moved = sector_error_px * solver.solve(sector);
        covariance += moved * moved.transpose();
    }
    const Eigen::MatrixXd moved = shared_error_px * solver.solve(everywhere);
    return covariance + moved * moved.transpose();
}

ModelDeviations bundle_deviations(const Bundle& bundle, const BundleOptions& options, double at_px,
                                  double shared_error_px) {
    const NumberPlaces places(options.free, std::vector<bool>(bundle.model.angles_rad.size(), true));
    return deviations_of(bundle.model, places, bundle_covariance(bundle, options, shared_error_px), at_px);
}

}  // namespace rs::capture
