#include "capture/calibration/points/bundle_deviations.hpp"

#include "capture/calibration/points/model_covariance.hpp"
#include "capture/calibration/points/reprojection.hpp"
#include "rayspace/base/conventions.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr std::size_t kSharedErrors = 4;
constexpr std::size_t kSectors = 12;  // sides of the object, each with errors of its own
// By how much a sector's numbers follow its own errors, and so hide them, is undone to this part: all of it is right
// where a sector errs as one, half of it where its tracks err each by itself.
constexpr double kUnhidden = 0.9;
// Of the scatter, what is counted by sector; the rest is counted by track, for so few sectors cannot tell of every
// number.
constexpr double kShareOfSectors = 0.9;

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

// What tracks say of the free numbers, their points eliminated.
struct Evidence {
    Eigen::MatrixXd information;
    Eigen::VectorXd score;
    Eigen::MatrixXd shared;  // what each shared error of 1 px does to the score

    explicit Evidence(int n)
        : information(Eigen::MatrixXd::Zero(n, n)),
          score(Eigen::VectorXd::Zero(n)),
          shared(Eigen::MatrixXd::Zero(n, kSharedErrors)) {}
    void add(const Evidence& other) {
        information += other.information;
        score += other.score;
        shared += other.shared;
    }
};

// One observation's residual and its derivatives, with those by the free numbers only.
struct Slopes {
    Eigen::Vector2d r;
    Eigen::Matrix<double, 2, 3, Eigen::RowMajor> by_point;
    std::array<std::pair<int, Eigen::Vector2d>, kCameraNumbers + 1> by_number;  // place and derivative
    std::size_t count = 0;                                                      // of by_number
};

std::optional<Slopes> slopes_of(const TurntableModel& model, const NumberPlaces& places, bool common_step,
                                const glm::dvec3& point, const Observation& seen) {
    const std::array<double, 5> lens{model.lens.f_px, model.lens.cx, model.lens.cy, model.lens.k1, model.lens.k2};
    const std::array<double, 3> pose{model.pose.pan_rad, model.pose.tilt_rad, model.pose.roll_rad};
    const auto view = static_cast<std::size_t>(seen.view);
    const double turns = common_step ? static_cast<double>(seen.view) : 1.0;
    const double angle = common_step && seen.view == 0 ? 0.0 : model.angles_rad[view] / turns;
    const Reprojection cost(seen, turns);
    const std::array<const double*, 4> blocks{lens.data(), pose.data(), &angle, &point.x};
    Slopes slopes;
    Eigen::Matrix<double, 2, 5, Eigen::RowMajor> by_lens;
    Eigen::Matrix<double, 2, 3, Eigen::RowMajor> by_pose;
    Eigen::Vector2d by_angle;
    std::array<double*, 4> jacobians{by_lens.data(), by_pose.data(), by_angle.data(), slopes.by_point.data()};
    if (!cost.Evaluate(blocks.data(), slopes.r.data(), jacobians.data())) return std::nullopt;
    const auto add = [&](int place, const Eigen::Vector2d& slope) {
        if (place >= 0) slopes.by_number[slopes.count++] = {place, slope};
    };
    for (int k = 0; k < 5; ++k) add(places.camera[static_cast<std::size_t>(k)], by_lens.col(k));
    for (int k = 0; k < 3; ++k) add(places.camera[static_cast<std::size_t>(5 + k)], by_pose.col(k));
    add(common_step ? places.step : places.angles[view], by_angle);
    return slopes;
}

// Nothing where the track does not determine its point.
std::optional<Evidence> evidence_of(const Bundle& bundle, std::size_t track, const NumberPlaces& places,
                                    const BundleOptions& options, double middle_rad) {
    const TurntableModel& model = bundle.model;
    const bool common_step = options.free.angles == AngleFreedom::kCommonStep;
    Evidence evidence(places.count);
    Eigen::MatrixXd across = Eigen::MatrixXd::Zero(places.count, 3);  // numbers by point
    Eigen::Matrix3d point_information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d point_score = Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 3, kSharedErrors> point_shared = Eigen::Matrix<double, 3, kSharedErrors>::Zero();
    for (const Observation& seen : bundle.tracks[track].seen) {
        const auto slopes = slopes_of(model, places, common_step, bundle.points[track], seen);
        if (!slopes) continue;
        // Cauchy's loss pulls at a residual with this weight, but gives way with its square (the mean over directions
        // of its second derivative): what is far off hardly holds the numbers where they are.
        const double pull = 1 / (1 + slopes->r.squaredNorm() / (options.loss_px * options.loss_px));
        const double firmness = pull * pull;
        Eigen::Matrix2d whitening;
        whitening << seen.weight[0][0], seen.weight[1][0], seen.weight[0][1], seen.weight[1][1];
        Eigen::Matrix<double, 2, kSharedErrors> error;
        const auto movements = shared_errors(model.angles_rad[static_cast<std::size_t>(seen.view)] - middle_rad);
        for (std::size_t k = 0; k < kSharedErrors; ++k) {
            error.col(static_cast<Eigen::Index>(k)) = whitening * movements[k];
        }
        for (std::size_t a = 0; a < slopes->count; ++a) {
            const auto& [place, slope] = slopes->by_number[a];
            evidence.score(place) += pull * slope.dot(slopes->r);
            evidence.shared.row(place) += firmness * slope.transpose() * error;
            across.row(place) += firmness * slope.transpose() * slopes->by_point;
            for (std::size_t b = 0; b < slopes->count; ++b) {
                const auto& [other, other_slope] = slopes->by_number[b];
                evidence.information(place, other) += firmness * slope.dot(other_slope);
            }
        }
        point_information += firmness * slopes->by_point.transpose() * slopes->by_point;
        point_score += pull * slopes->by_point.transpose() * slopes->r;
        point_shared += firmness * slopes->by_point.transpose() * error;
    }
    const Eigen::Matrix3d inverse = point_information.inverse();
    if (!inverse.allFinite()) return std::nullopt;
    evidence.information -= across * inverse * across.transpose();
    evidence.score -= across * inverse * point_score;
    evidence.shared -= across * inverse * point_shared;
    return evidence;
}

// What the adjustment is told beforehand of the lens: the diagonal of its information.
Eigen::VectorXd prior_information(const TurntableModel& model, const NumberPlaces& places, double loss_px) {
    const std::array<double, 5> deviations{0, kPriorPrincipalPoint * model.lens.width,
                                           kPriorPrincipalPoint * model.lens.width, kPriorK1, kPriorK2};
    Eigen::VectorXd information = Eigen::VectorXd::Zero(places.count);
    for (std::size_t k = 1; k < deviations.size(); ++k) {
        if (places.camera[k] >= 0) information(places.camera[k]) = std::pow(loss_px / deviations[k], 2);
    }
    return information;
}

std::size_t sector_at(double angle_rad) {
    const double around = angle_rad / (2 * kPi) + 0.5;
    return static_cast<std::size_t>(around * static_cast<double>(kSectors)) % kSectors;
}

}  // namespace

Eigen::MatrixXd bundle_covariance(const Bundle& bundle, const BundleOptions& options, double shared_error_px) {
    const NumberPlaces places(options.free, std::vector<bool>(bundle.model.angles_rad.size(), true));
    const int n = places.count;
    Evidence all(n);
    std::vector<Evidence> sectors(kSectors, all);
    Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(n, n);
    int counted = 0;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        const double middle_rad = middle_angle(bundle.model, bundle.tracks[i]);
        const auto evidence = evidence_of(bundle, i, places, options, middle_rad);
        if (!evidence) continue;
        all.add(*evidence);
        sectors[sector_at(middle_rad)].add(*evidence);
        meat += (1 - kShareOfSectors) * evidence->score * evidence->score.transpose();
        ++counted;
    }
    if (counted <= n) return {};
    const Eigen::VectorXd prior = prior_information(bundle.model, places, options.loss_px);
    all.information += Eigen::MatrixXd(prior.asDiagonal());
    meat += Eigen::MatrixXd((options.loss_px * options.loss_px * prior).asDiagonal());
    const Eigen::LDLT<Eigen::MatrixXd> solver(all.information);
    if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-15)) return {};

    const Eigen::MatrixXd half = solver.solve(meat);
    Eigen::MatrixXd covariance = solver.solve(half.transpose());
    for (const Evidence& sector : sectors) {
        const Eigen::LDLT<Eigen::MatrixXd> others(all.information - kUnhidden * sector.information);
        const Eigen::VectorXd moved = others.solve(sector.score);
        covariance += kShareOfSectors * moved * moved.transpose();
    }
    const Eigen::MatrixXd moved = shared_error_px * solver.solve(all.shared);
    return covariance + moved * moved.transpose();
}

ModelDeviations bundle_deviations(const Bundle& bundle, const BundleOptions& options, double at_px,
                                  double shared_error_px) {
    const NumberPlaces places(options.free, std::vector<bool>(bundle.model.angles_rad.size(), true));
    return deviations_of(bundle.model, places, bundle_covariance(bundle, options, shared_error_px), at_px);
}

}  // namespace rs::capture
