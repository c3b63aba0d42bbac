#include "capture/calibration/points/model_covariance.hpp"

#include "rayspace/base/conventions.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

// Derivatives of the axis' position by the camera's numbers, by finite differences.
std::array<double, kCameraParameters> axis_slopes(const TurntableModel& model, double at_px) {
    std::array<double, kCameraParameters> slopes{};
    for (std::size_t k = 0; k < slopes.size(); ++k) {
        const double step = k < 3 ? 1e-3 : 1e-6;
        std::array<double, 2> value{};
        for (std::size_t side = 0; side < 2; ++side) {
            Lens lens = model.lens;
            CameraPose pose = model.pose;
            const std::array<double*, kCameraParameters> numbers{
                &lens.f_px, &lens.cx, &lens.cy, &lens.k1, &lens.k2, &pose.pan_rad, &pose.tilt_rad, &pose.roll_rad};
            *numbers[k] += side == 0 ? -step : step;
            value[side] = axis_position(lens, pose, at_px).value_or(0);
        }
        slopes[k] = (value[1] - value[0]) / (2 * step);
    }
    return slopes;
}

}  // namespace

ParameterIndices::ParameterIndices(const BundleFreedom& free, const std::vector<bool>& is_seen) {
    const std::array<bool, kCameraParameters> camera_free{
        free.f, free.principal_point, free.principal_point, free.k1, free.k2, free.pan, free.tilt, free.roll};
    for (std::size_t k = 0; k < kCameraParameters; ++k) camera[k] = camera_free[k] ? count++ : -1;
    for (std::size_t view = 0; view < is_seen.size(); ++view) {
        const bool is_free = free.angles == AngleFreedom::kEach && view > 0 && is_seen[view];
        angles.push_back(is_free ? count++ : -1);
    }
    if (free.angles == AngleFreedom::kCommonStep) step = count++;
}

TurntableModel apply_step(TurntableModel model, const ParameterIndices& places, const Eigen::VectorXd& step) {
    const std::array<double*, kCameraParameters> numbers{&model.lens.f_px,     &model.lens.cx,      &model.lens.cy,
                                                         &model.lens.k1,       &model.lens.k2,      &model.pose.pan_rad,
                                                         &model.pose.tilt_rad, &model.pose.roll_rad};
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        if (places.camera[k] >= 0) *numbers[k] += step(places.camera[k]);
    }
    for (std::size_t view = 0; view < model.angles_rad.size(); ++view) {
        if (places.angles[view] >= 0) model.angles_rad[view] += step(places.angles[view]);
        if (places.step >= 0) model.angles_rad[view] += static_cast<double>(view) * step(places.step);
    }
    return model;
}

ModelDeviations standard_deviations(const TurntableModel& model, const ParameterIndices& places,
                                    const Eigen::MatrixXd& covariance, double at_px) {
    if (covariance.size() == 0 && places.count > 0) {
        ModelDeviations unknown;
        unknown.angles_rad.assign(model.angles_rad.size(), std::numeric_limits<double>::infinity());
        return unknown;
    }
    const auto of = [&](const Eigen::VectorXd& gradient) {
        return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
    };
    const auto one = [&](std::size_t number) {
        const int place = places.camera[number];
        return place < 0 ? 0.0 : std::sqrt(std::max(0.0, covariance(place, place)));
    };
    ModelDeviations deviations;
    deviations.f_px = one(CameraParameter::kF);
    deviations.cx = one(CameraParameter::kCx);
    deviations.cy = one(CameraParameter::kCy);
    deviations.k1 = one(CameraParameter::kK1);
    deviations.k2 = one(CameraParameter::kK2);
    deviations.tilt_rad = one(CameraParameter::kTilt);
    deviations.roll_rad = one(CameraParameter::kRoll);
    deviations.axis_direction_rad =
        std::hypot(deviations.tilt_rad, std::cos(model.pose.tilt_rad) * deviations.roll_rad);
    const auto slopes = axis_slopes(model, at_px);
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(covariance.rows());
    for (std::size_t k = 0; k < slopes.size(); ++k) {
        if (places.camera[k] >= 0) gradient(places.camera[k]) = slopes[k];
    }
    deviations.axis_position_px = of(gradient);
    // Angles are relative to the mean of all views; relative to the first view they would all contain its error.
    const std::size_t views = places.angles.size();
    for (std::size_t view = 0; view < views; ++view) {
        Eigen::VectorXd from_mean = Eigen::VectorXd::Zero(covariance.rows());
        for (std::size_t other = 0; other < views; ++other) {
            const int place = places.angles[other];
            if (place >= 0) from_mean(place) = (other == view ? 1.0 : 0.0) - 1.0 / static_cast<double>(views);
        }
        if (places.step >= 0) {
            from_mean(places.step) = static_cast<double>(view) - 0.5 * static_cast<double>(views - 1);
        }
        deviations.angles_rad.push_back(of(from_mean));
    }
    return deviations;
}

namespace {

constexpr std::size_t kSharedErrors = 4;
constexpr std::size_t kSectors = 12;  // sides of the object with a common error each
// Exponent of the correction for a sector's numbers following its own errors: 1 is right where a sector has a single
// error, 1/2 where its tracks have independent ones.
constexpr double kUnhidden = 0.9;
// Share of the scatter that is computed by sector; the rest is computed by track, because so few sectors do not span
// all numbers.
constexpr double kShareOfSectors = 0.9;

// Apparent movements of a point per px of shared error, at `beside_rad` from the middle of its views.
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

// Information and score of tracks about the free numbers, their points eliminated.
struct Evidence {
    Eigen::MatrixXd information;
    Eigen::VectorXd score;
    Eigen::MatrixXd shared;  // effect of each shared error of 1 px on the score

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

Eigen::Vector2d vector(const glm::dvec2& v) {
    return {v.x, v.y};
}

// Residual of one observation and its derivatives by the point and by the free numbers.
struct Slopes {
    Eigen::Vector2d r;
    Eigen::Matrix<double, 2, 3, Eigen::RowMajor> by_point;
    std::array<std::pair<int, Eigen::Vector2d>, kCameraParameters + 1> by_number;  // index and derivative
    std::size_t count = 0;                                                         // of entries in by_number
};

std::optional<Slopes> slopes_of(const Reprojections& turn, const ParameterIndices& places, const glm::dvec3& point,
                                const Observation& seen) {
    const auto reprojection = turn.of(point, seen);
    if (!reprojection) return std::nullopt;
    Slopes slopes;
    slopes.r = vector(reprojection->residual);
    for (int k = 0; k < 3; ++k) slopes.by_point.col(k) = vector(reprojection->by_point[static_cast<std::size_t>(k)]);
    const auto add = [&](int place, const glm::dvec2& slope) {
        if (place >= 0) slopes.by_number[slopes.count++] = {place, vector(slope)};
    };
    for (std::size_t k = 0; k < kCameraParameters; ++k) add(places.camera[k], reprojection->by_camera[k]);
    add(places.angles[static_cast<std::size_t>(seen.view)], reprojection->by_angle);
    add(places.step, static_cast<double>(seen.view) * reprojection->by_angle);
    return slopes;
}

// Nothing if the track does not determine its point.
std::optional<Evidence> evidence_of(const Bundle& bundle, const Reprojections& turn, std::size_t track,
                                    const ParameterIndices& places, const BundleOptions& options, double middle_rad) {
    const TurntableModel& model = bundle.model;
    Evidence evidence(places.count);
    Eigen::MatrixXd across = Eigen::MatrixXd::Zero(places.count, 3);  // numbers by point
    Eigen::Matrix3d point_information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d point_score = Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 3, kSharedErrors> point_shared = Eigen::Matrix<double, 3, kSharedErrors>::Zero();
    for (const Observation& seen : bundle.tracks[track].seen) {
        const auto slopes = slopes_of(turn, places, bundle.points[track], seen);
        if (!slopes) continue;
        // Cauchy's loss weights a residual with `pull`, but its second derivative (the mean over directions) is the
        // square of that: outliers hardly contribute information.
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

// Information of the lens priors: the diagonal.
Eigen::VectorXd prior_information(const TurntableModel& model, const ParameterIndices& places, double loss_px) {
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
    const ParameterIndices places(options.free, std::vector<bool>(bundle.model.angles_rad.size(), true));
    const Reprojections turn(bundle.model);
    const int n = places.count;
    Evidence all(n);
    std::vector<Evidence> sectors(kSectors, all);
    Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(n, n);
    int counted = 0;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        const double middle_rad = middle_angle(bundle.model, bundle.tracks[i]);
        const auto evidence = evidence_of(bundle, turn, i, places, options, middle_rad);
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

ModelDeviations bundle_standard_deviations(const Bundle& bundle, const BundleOptions& options, double at_px,
                                           double shared_error_px) {
    const ParameterIndices places(options.free, std::vector<bool>(bundle.model.angles_rad.size(), true));
    return standard_deviations(bundle.model, places, bundle_covariance(bundle, options, shared_error_px), at_px);
}

}  // namespace rs::capture
