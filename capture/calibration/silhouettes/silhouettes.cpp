#include "capture/calibration/silhouettes/silhouettes.hpp"

#include "capture/calibration/points/model_covariance.hpp"
#include "capture/calibration/silhouettes/coherence_fit.hpp"
#include "capture/calibration/silhouettes/silhouette_fit.hpp"
#include "capture/calibration/silhouettes/silhouette_turn.hpp"
#include "capture/calibration/silhouettes/turn_diagnosis.hpp"
#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
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

// Error of assumed angles, one standard deviation of each.
constexpr double kAssumedAngle_deg = 3;

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

struct SilhouetteAngles {
    TurntableModel model;
    ModelDeviations deviations;
};

// Refines `model`, fitted under assumed angles, with `deviations`: estimates angles, lens and orientation together,
// each with its deviation as prior. Both in px of the photos, of which `masks` are reduced copies. Numbers in `known`,
// the principal point and k2 are held constant. Nothing if angles are known, if the silhouettes hardly determine them
// or are not consistent, or if the object touches the image border. About 10 s for 36 views on 2 cores.
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

using Parameters = SilhouetteParameters;

constexpr std::array<double, 9> kAxisTries = {0, -0.03, 0.03, -0.06, 0.06, -0.1, 0.1, -0.15, 0.15};  // of the width
constexpr std::array<double, 5> kTiltTries_deg = {0, 10, 20, 35, -10};                               // from the start
constexpr std::array<double, 7> kTiltsCompared_deg = {-30, -15, -5, 0, 5, 15, 30};                   // from the start
constexpr std::size_t kBestTries = 4;
constexpr double kSearchOutlier_px = 12;
constexpr std::size_t kGroups = 6;            // of the jackknife
constexpr double kGoodEnough_px = 1;          // a start with smaller residuals needs no improvement, reduced px
constexpr double kGoodSilhouettes_px = 0.35;  // residuals of good silhouettes, reduced px
constexpr double kDisagree_px = 3;            // fits with larger residuals are rejected, reduced px
constexpr double kImprovement = 0.98;         // required ratio of costs

Lens scaled(const Lens& lens, double by) {
    Lens result = lens;
    result.f_px *= by;
    result.cx *= by;
    result.cy *= by;
    return result;
}

Status check_start(std::span<const Image<std::uint8_t>> masks, const TurntableModel& start) {
    if (start.angles_rad.size() != masks.size()) {
        return Error{"silhouettes: " + std::to_string(masks.size()) + " silhouettes but " +
                     std::to_string(start.angles_rad.size()) + " angles; give one angle per view"};
    }
    if (!(start.lens.f_px > 0) || start.lens.width <= 0 || start.lens.height <= 0) {
        return Error{"silhouettes: the assumed lens has no focal length or no image size"};
    }
    const double scale = static_cast<double>(masks[0].width()) / start.lens.width;
    if (scale > 1 || std::abs(masks[0].height() - scale * start.lens.height) > 1) {
        return Error{"silhouettes: masks of " + std::to_string(masks[0].width()) + " x " +
                     std::to_string(masks[0].height()) + " pixels are no reduced images of " +
                     std::to_string(start.lens.width) + " x " + std::to_string(start.lens.height)};
    }
    return {};
}

// Fits each point of a coarse grid over axis and tilt with few rays, then refines the best with all.
SilhouetteFit search_start(SilhouetteProblem problem) {
    const double width_px = problem.turn->width_px();
    std::vector<SilhouetteFit> tries;
    problem.outlier_px = kSearchOutlier_px;
    for (const double axis : kAxisTries) {
        if (!problem.free[Parameters::kAxis] && axis != 0) continue;
        for (const double tilt_deg : kTiltTries_deg) {
            if (!problem.free[Parameters::kTilt] && tilt_deg != 0) continue;
            SilhouetteFit each;
            each.at.value[Parameters::kAxis] = axis * width_px;
            each.at.value[Parameters::kTilt] = radians(tilt_deg);
            each.cost = silhouette_cost(problem, each.at, {6, {}});
            tries.push_back(each);
        }
    }
    const auto better = [](const SilhouetteFit& a, const SilhouetteFit& b) { return a.cost < b.cost; };
    std::stable_sort(tries.begin(), tries.end(), better);
    tries.resize(std::min(tries.size(), kBestTries));
    for (SilhouetteFit& each : tries) each = fit_silhouettes(problem, each.at, {4, {}}, 8);
    std::stable_sort(tries.begin(), tries.end(), better);
    problem.outlier_px = SilhouetteProblem{}.outlier_px;
    return fit_silhouettes(problem, tries[0].at, {1, {}}, 10);
}

// The best fits with the tilt held at several values. Silhouettes may leave a valley of tilts with another axis and
// lens for each, which the curvature at one point of it does not show.
std::vector<SilhouetteFit> fit_fixed_tilts(SilhouetteProblem problem, const SilhouetteFit& fit,
                                           const RaySelection& rays) {
    std::vector<SilhouetteFit> fits;
    if (!problem.free[Parameters::kTilt]) return fits;
    problem.free[Parameters::kTilt] = false;
    for (const double tilt_deg : kTiltsCompared_deg) {
        Parameters at = fit.at;
        at.value[Parameters::kTilt] = radians(tilt_deg);
        fits.push_back(fit_silhouettes(problem, at, rays, 6));
        fits.back().deviation = fit.deviation;
    }
    return fits;
}

// If the best fit is better by less than one standard error, the tilt nearest to the start is as good.
SilhouetteFit nearest_to_start(const SilhouetteFit& fit, double fit_cost, const std::vector<SilhouetteFit>& along) {
    SilhouetteFit nearest = fit;
    for (const SilhouetteFit& each : along) {
        const bool nearer =
            std::abs(each.at.value[Parameters::kTilt]) < std::abs(nearest.at.value[Parameters::kTilt]) - 1e-9;
        if (nearer && each.cost < fit_cost + 1) nearest = each;
    }
    return nearest;
}

// Deviation of each number if one of the fits along the tilts is the truth: the full distance if that fit is as good,
// less in proportion to the standard errors by which it is worse; for a parabolic cost this is one standard deviation.
std::array<double, Parameters::kCount> tilt_valley_deviations(const SilhouetteFit& fit, double fit_cost,
                                                              const std::vector<SilhouetteFit>& along) {
    std::array<double, Parameters::kCount> deviation{};
    for (const SilhouetteFit& each : along) {
        for (std::size_t k = 0; k < Parameters::kCount; ++k) {
            const double apart = std::abs(each.at.value[k] - fit.at.value[k]);
            deviation[k] = std::max(deviation[k], apart / std::sqrt(std::max(1.0, each.cost - fit_cost)));
        }
    }
    for (std::size_t k = 0; k < Parameters::kCount; ++k) {
        if (deviation[k] > kUndeterminedShare * kSilhouettePriors[k])
            deviation[k] = std::numeric_limits<double>::infinity();
    }
    return deviation;
}

// Jackknife over interleaved groups of views, which includes errors that neighbouring points share.
std::array<double, Parameters::kCount> jackknife_deviations(const SilhouetteProblem& problem,
                                                            const SilhouetteFit& fit) {
    const std::size_t views = problem.turn->views();
    const std::size_t groups = std::min(kGroups, views / 3);
    std::vector<Parameters> without;
    for (std::size_t g = 0; g < groups; ++g) {
        RaySelection rays{2, {}};
        for (std::size_t i = 0; i < views; ++i) rays.left_out.push_back(i % groups == g ? 1 : 0);
        without.push_back(fit_silhouettes(problem, fit.at, rays, 3).at);
    }
    std::array<double, Parameters::kCount> deviation{};
    const auto n = static_cast<double>(groups);
    for (std::size_t k = 0; k < Parameters::kCount; ++k) {
        double mean = 0;
        for (const Parameters& each : without) mean += each.value[k] / n;
        double sum = 0;
        for (const Parameters& each : without) sum += (each.value[k] - mean) * (each.value[k] - mean);
        deviation[k] = std::sqrt(sum * (n - 1) / n);
    }
    return deviation;
}

ModelDeviations standard_deviations(const SilhouetteFit& fit, const std::array<double, Parameters::kCount>& spread,
                                    const TurntableModel& model, const KnownInputs& known, double image_px) {
    const auto of = [&](Parameters::Name name) { return std::max(fit.deviation[name], spread[name]); };
    ModelDeviations deviations;
    deviations.f_px = of(Parameters::kLogF) * model.lens.f_px;
    deviations.tilt_rad = of(Parameters::kTilt);
    deviations.roll_rad = of(Parameters::kRoll);
    deviations.axis_direction_rad = std::hypot(deviations.tilt_rad, deviations.roll_rad);
    deviations.axis_position_px = of(Parameters::kAxis) * image_px;
    if (known.principal_point) deviations.cx = deviations.cy = 0;
    if (known.distortion) deviations.k1 = deviations.k2 = 0;
    const bool angles_known = known.step_rad || known.angles_rad;
    const double mean_rad = [&] {
        double sum = 0;
        for (const double angle : model.angles_rad) sum += angle / static_cast<double>(model.angles_rad.size());
        return sum;
    }();
    for (const double angle : model.angles_rad) {
        // The accuracy of assumed angles is unknown; that of estimated ones follows from their common step.
        double deviation = angles_known ? 0 : std::numeric_limits<double>::infinity();
        if (fit.deviation[Parameters::kStep] > 0) deviation = of(Parameters::kStep) * std::abs(angle - mean_rad);
        deviations.angles_rad.push_back(deviation);
    }
    return deviations;
}

std::vector<ViewFit> fits_by_view(const SilhouetteTurn& turn, const std::vector<double>& residuals, double image_px) {
    const std::vector<std::size_t> view_of = views_of_rays(turn, {});
    std::vector<ViewFit> views(turn.views());
    for (std::size_t r = 0; r < residuals.size(); ++r) {
        ++views[view_of[r]].observations;
        views[view_of[r]].rms_px += residuals[r] * residuals[r];
    }
    for (ViewFit& view : views)
        view.rms_px = view.observations > 0 ? image_px * std::sqrt(view.rms_px / view.observations) : 0;
    return views;
}

void add_warnings(Calibration& calibration, const SilhouetteTurn& turn) {
    const ModelDeviations& d = calibration.deviations;
    auto& warnings = calibration.warnings;
    if (std::isinf(d.tilt_rad)) {
        warnings.emplace_back(
            "the silhouettes do not determine how far the camera looks down (a round object looks the same from all "
            "sides): its height is assumed; put a printed board under the object");
    } else if (is_seen_from_below(calibration)) {
        warnings.emplace_back(
            "the silhouettes fit a camera that looks up from below; if it looks down, the object turns the other way: "
            "give the other direction of turning");
    }
    if (!(d.f_px < 0.15 * calibration.model.lens.f_px)) {
        warnings.emplace_back(
            "the silhouettes do not determine the lens: its focal length is assumed; give it if it is known");
    }
    if (turn.touches_border()) {
        warnings.emplace_back("the object reaches the border of the images: regions outside were not compared");
    }
    for (std::size_t i = 0; i < calibration.views.size(); ++i) {
        const double limit = std::max(3 * calibration.rms_px, 2.0 * turn.reduction());
        if (calibration.views[i].rms_px > limit) {
            warnings.push_back(
                "the silhouette of view " + std::to_string(i + 1) +
                " does not fit the others; check its mask and whether the object moved on the turntable");
        }
    }
}

}  // namespace

bool is_seen_from_below(const Calibration& found) {
    return found.model.pose.tilt_rad < -std::max(2 * found.deviations.tilt_rad, radians(3));
}

Result<Calibration> calibrate_with_silhouettes(std::span<const Image<std::uint8_t>> masks, const TurntableModel& start,
                                               const KnownInputs& known) {
    RS_ASSIGN_OR_RETURN(auto turn, SilhouetteTurn::create(masks));
    const TurntableModel held = apply_known(start, known);
    RS_TRY(check_start(masks, held));

    // Photo px per px of the turn.
    const double image_px = turn.reduction() * static_cast<double>(start.lens.width) / masks[0].width();
    SilhouetteProblem problem;
    problem.turn = &turn;
    problem.start = held;
    problem.start.lens = scaled(held.lens, 1 / image_px);
    const bool pose_free = !known.pose;
    problem.free = {pose_free, pose_free, pose_free, !known.f_px, !known.step_rad && !known.angles_rad};

    const auto disagreement = [&](double apart_px) {
        return Error{"silhouettes: the silhouettes disagree by " + std::to_string(std::lround(apart_px * image_px)) +
                     " pixels with every single turn; check the steps, the direction of turning and the masks"};
    };
    const SilhouetteFit best = search_start(problem);
    const double start_rms = rms_px(consistency_residuals_px(turn, problem.start, {}));
    if (start_rms > kGoodEnough_px && !(best.cost < kImprovement * silhouette_cost(problem, {}, {}))) {
        return Error{
            "silhouettes: no axis, tilt, roll or focal length near the assumed ones makes the silhouettes agree "
            "better; check the steps, the direction of turning and the masks"};
    }
    // The following steps estimate the accuracy; they cannot repair silhouettes that disagree so much.
    const double best_rms = rms_px(consistency_residuals_px(turn, apply_changes(problem.start, best.at), {}));
    if (best_rms > kDisagree_px) return disagreement(best_rms);
    const RaySelection half{2, {}};
    const double best_cost = silhouette_cost(problem, best.at, half);
    const std::vector<SilhouetteFit> along = fit_fixed_tilts(problem, best, half);
    SilhouetteFit fit = nearest_to_start(best, best_cost, along);
    Calibration calibration;
    calibration.method = CalibrationMethod::kSilhouettes;
    TurntableModel of_turn = apply_changes(problem.start, fit.at);
    std::vector<double> residuals = consistency_residuals_px(turn, of_turn, {});
    calibration.model = of_turn;
    calibration.model.lens = scaled(calibration.model.lens, image_px);
    std::array<double, Parameters::kCount> spread = jackknife_deviations(problem, fit);
    const std::array<double, Parameters::kCount> open = tilt_valley_deviations(fit, best_cost, along);
    // Silhouettes that fit worse than good ones make all numbers less certain.
    const double doubt = std::max(1.0, rms_px(residuals) / kGoodSilhouettes_px);
    for (std::size_t k = 0; k < Parameters::kCount; ++k) {
        spread[k] = std::max(spread[k], doubt * open[k]);
        fit.deviation[k] *= doubt;
    }
    calibration.deviations = standard_deviations(fit, spread, calibration.model, known, image_px);
    if (auto found = estimate_angles(masks, calibration.model, calibration.deviations, known)) {
        calibration.model = std::move(found->model);
        calibration.deviations = std::move(found->deviations);
        of_turn = calibration.model;
        of_turn.lens = scaled(of_turn.lens, 1 / image_px);
        residuals = consistency_residuals_px(turn, of_turn, {});
    }
    const double fit_rms = rms_px(residuals);
    if (fit_rms > kDisagree_px) return disagreement(fit_rms);
    calibration.observations = static_cast<int>(residuals.size());
    calibration.rms_px = fit_rms * image_px;
    calibration.views = fits_by_view(turn, residuals, image_px);
    calibration.step_rad = median_step(calibration.model.angles_rad);
    add_warnings(calibration, turn);
    return calibration;
}

}  // namespace rs::capture
