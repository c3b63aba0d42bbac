#include "capture/calibration/silhouettes/silhouette_angles.hpp"

#include "capture/calibration/points/model_covariance.hpp"
#include "capture/calibration/silhouettes/coherence_fit.hpp"
#include "capture/calibration/silhouettes/silhouette_fit.hpp"
#include "capture/calibration/silhouettes/silhouette_turn.hpp"
#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace rs::capture {
namespace {

const SilhouetteDetail kDetail{600, 200};

// Factor for deviations found under wrong angles, which are too small; also prevents the same silhouettes from counting
// twice.
constexpr double kWider = 3;
constexpr double kDistortion = 0.1;  // standard deviation of k1 of typical lenses
constexpr double kWorst_px = 1;      // of the turn
// Chosen so that twice the deviations covered the errors on ten rendered dolls and a lattice.
constexpr double kCommonErrorFactor = 3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Deviations of f, tilt, roll and the axis' position if silhouettes do not determine them.
std::array<double, SilhouetteParameters::kCount> unknown_deviations(const TurntableModel& model, double image_px) {
    std::array<double, SilhouetteParameters::kCount> all = kSilhouettePriors;
    all[SilhouetteParameters::kLogF] *= model.lens.f_px;
    all[SilhouetteParameters::kAxis] *= image_px;
    return all;
}

Eigen::MatrixXd prior_covariance(const TurntableModel& model, const ParameterIndices& places,
                                 const ModelDeviations& deviations, double image_px) {
    using Name = SilhouetteParameters;
    const auto unknown = unknown_deviations(model, image_px);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(places.count, places.count);
    const auto set = [&](std::size_t number, double deviation) {
        if (const int k = places.camera[number]; k >= 0) covariance(k, k) = deviation * deviation;
    };
    set(CameraParameter::kF, std::min(kWider * deviations.f_px, unknown[Name::kLogF]));
    set(CameraParameter::kK1, kDistortion);
    set(CameraParameter::kPan, std::min(kWider * deviations.axis_position_px, unknown[Name::kAxis]) / model.lens.f_px);
    set(CameraParameter::kTilt, std::min(kWider * deviations.tilt_rad, unknown[Name::kTilt]));
    set(CameraParameter::kRoll, std::min(kWider * deviations.roll_rad, unknown[Name::kRoll]));
    // Angles are relative to the first view's, whose own error is common to all of them.
    const double variance = std::pow(radians(kAssumedAngle_deg), 2);
    for (const int i : places.angles) {
        for (const int j : places.angles) {
            if (i >= 0 && j >= 0) covariance(i, j) = i == j ? 2 * variance : variance;
        }
    }
    return covariance;
}

// Sets the deviations of numbers to infinity that were not estimated or that are hardly better than their prior.
void mark_undetermined(ModelDeviations& deviations, const TurntableModel& model, const KnownInputs& known,
                       double image_px) {
    const auto unknown = unknown_deviations(model, image_px);
    const auto limited = [](double deviation, double before) {
        return deviation < kUndeterminedShare * before ? deviation : kInfinity;
    };
    deviations.f_px = limited(deviations.f_px, unknown[SilhouetteParameters::kLogF]);
    deviations.tilt_rad = limited(deviations.tilt_rad, unknown[SilhouetteParameters::kTilt]);
    deviations.roll_rad = limited(deviations.roll_rad, unknown[SilhouetteParameters::kRoll]);
    deviations.axis_direction_rad = std::hypot(deviations.tilt_rad, deviations.roll_rad);
    deviations.axis_position_px = limited(deviations.axis_position_px, unknown[SilhouetteParameters::kAxis]);
    for (double& angle : deviations.angles_rad) angle = limited(angle, radians(kAssumedAngle_deg));
    if (!known.distortion) {
        deviations.k1 = limited(deviations.k1, kDistortion);
        deviations.k2 = kInfinity;
    }
    if (!known.principal_point) deviations.cx = deviations.cy = kInfinity;
}

}  // namespace

std::optional<SilhouetteAngles> estimate_angles(std::span<const Image<std::uint8_t>> masks, const TurntableModel& model,
                                                const ModelDeviations& deviations, const KnownInputs& known) {
    if (known.angles_rad || known.step_rad || known.equal_steps) return std::nullopt;
    const auto turn = SilhouetteTurn::create(masks, kDetail);
    if (!turn || turn->touches_border()) return std::nullopt;
    const double image_px = turn->reduction() * static_cast<double>(model.lens.width) / masks[0].width();
    BundleFreedom free;
    free.f = !known.f_px;
    free.k1 = !known.distortion;
    free.pan = free.tilt = free.roll = !known.pose;
    const ParameterIndices places(free, std::vector<bool>(model.angles_rad.size(), true));
    const CoherenceOptions options{kWorst_px * image_px, places.count, kCommonErrorFactor};
    const auto fit =
        fit_coherence(model, places, prior_covariance(model, places, deviations, image_px), *turn, image_px, options);
    if (!fit) return std::nullopt;
    const double at_px = 0.5 * (has_sideways_axis(fit->model.pose) ? model.lens.width : model.lens.height);
    SilhouetteAngles found{fit->model, standard_deviations(fit->model, places, fit->covariance, at_px)};
    mark_undetermined(found.deviations, model, known, image_px);
    return found;
}

}  // namespace rs::capture
