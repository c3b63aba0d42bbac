#include "capture/calibration/tracks/track_calibration.hpp"

#include "capture/calibration/points/model_covariance.hpp"
#include "capture/calibration/points/patch_alignment.hpp"
#include "capture/calibration/points/placement_estimation.hpp"
#include "capture/calibration/silhouettes/turn_diagnosis.hpp"
#include "capture/calibration/tracks/silhouette_refinement.hpp"
#include "rayspace/base/conventions.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

constexpr std::size_t kFewestViews = 5;
constexpr std::size_t kFewestTracks = 40;
constexpr std::size_t kTrackHeldOutEvery = 10;  // of the tracks
constexpr double kFewestAgreeingPlaced = 0.75;
constexpr int kPlaceRounds = 1;
constexpr double kLossDeviations = 2;
constexpr double kTrackOutlierDeviations = 4;
constexpr double kSharedError_px = 0.2;  // calibrated on photos with ground truth
constexpr std::size_t kEnoughWideTracks = 80;
constexpr double kWideArc_rad = 0.35;
constexpr std::size_t kEnoughTracks = 2000;  // more would only cost time
constexpr int kObservationsPerView = 280;    // points are grown until each view has so many
constexpr int kAlignmentRounds = 2;
constexpr int kMostAlignmentRounds = 3;  // while points are added
constexpr double kRadiusMargin = 1.15;   // factor on the radius of the known points, for those not found yet
constexpr double kLeastOutlierLimit_px = 0.8;
constexpr double kAlignedLimit_px = 1;  // larger residuals are alignments to another place
// Adjustments followed by a new selection of observations need not be accurate.
constexpr int kRoughIterations = 12;
constexpr double kRoughlyEnough = 1e-4;

void split(const std::vector<Track>& tracks, std::vector<Track>& part, std::vector<Track>& held_out) {
    for (std::size_t i = 0; i < tracks.size(); ++i)
        (i % kTrackHeldOutEvery == 3 ? held_out : part).push_back(tracks[i]);
}

double outlier_limit(const Bundle& bundle, int reduction) {
    return std::max(kLeastOutlierLimit_px * reduction, kTrackOutlierDeviations * robust_deviation_px(bundle));
}

std::vector<ViewFit> view_fits(const Bundle& bundle) {
    const TurnProjection turn(bundle.model);
    std::vector<ViewFit> views(bundle.model.angles_rad.size());
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        for (const Observation& seen : bundle.tracks[i].seen) {
            const auto r = residual(turn, bundle.points[i], seen);
            if (!r) continue;
            ViewFit& fit = views[static_cast<std::size_t>(seen.view)];
            ++fit.observations;
            fit.rms_px += glm::dot(*r, *r);
        }
    }
    for (ViewFit& fit : views) fit.rms_px = fit.observations > 0 ? std::sqrt(fit.rms_px / fit.observations) : 0;
    return views;
}

// Takes from the two equivalent models with opposite axis directions the one whose camera looks down if the axis is
// sideways, because the image does not define an upper end then.
void choose_axis_direction(Bundle& bundle) {
    CameraPose& pose = bundle.model.pose;
    if (!has_sideways_axis(pose) || pose.tilt_rad >= 0) return;
    pose.tilt_rad = -pose.tilt_rad;
    pose.pan_rad = -pose.pan_rad;
    pose.roll_rad += pose.roll_rad > 0 ? -kPi : kPi;
    for (double& angle : bundle.model.angles_rad) angle = -angle;
    for (glm::dvec3& p : bundle.points) p = {-p.x, -p.y, p.z};
}

// 98th percentile of the points' distances from the axis; the farthest few may be wrong.
double farthest_radius(const Bundle& bundle) {
    std::vector<double> radii;
    for (const glm::dvec3& p : bundle.points) radii.push_back(std::hypot(p.x, p.z));
    const auto most = radii.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(radii.size() - 1));
    std::nth_element(radii.begin(), most, radii.end());
    return *most;
}

const char* const kNoSolution = "the bundle adjustment fails; are the images in order?";

Lens known_lens(const TurnImages& turn, const KnownInputs& known) {
    return apply_known(Lens{turn.width, turn.height, 0, turn.width / 2.0, turn.height / 2.0, 0, 0}, known);
}

BundleOptions rough_options(BundleOptions options) {
    options.max_iterations = kRoughIterations;
    options.function_tolerance = kRoughlyEnough;
    return options;
}

// Iterates adjustment and outlier rejection from an approximate start, with the detected features; accurate enough for
// plausibility checks. Sets the loss in `options` to fit the residuals.
bool adjust_robustly(Bundle& bundle, std::span<const Track> tracks, int reduction, bool k1_is_free,
                     BundleOptions& options) {
    constexpr int kMostRounds = 5;
    constexpr double kSameLoss = 0.02;
    options.loss_px = 2.0 * reduction;
    for (int round = 0; round < kMostRounds; ++round) {
        options.free.k1 = round > 0 && k1_is_free;
        if (!adjust(bundle, rough_options(options))) return false;
        const double limit = outlier_limit(bundle, reduction);
        // Observations rejected because of a poor start are reconsidered.
        if (round + 1 < kMostRounds) {
            bundle = make_robust_bundle(bundle.model, tracks, limit);
        } else {
            drop_outliers(bundle, limit);
        }
        const double before_px = options.loss_px;
        options.loss_px = std::max(0.3 * reduction, 2 * robust_deviation_px(bundle));
        if (round > 1 && std::abs(options.loss_px / before_px - 1) < kSameLoss) break;
    }
    return adjust(bundle, rough_options(options)).has_value();
}

// Range of angles in which a track is seen, rad.
double arc_rad(const TurntableModel& model, const Track& track) {
    const double first = model.angles_rad[static_cast<std::size_t>(track.seen.front().view)];
    double low = 0, high = 0;
    for (const Observation& seen : track.seen) {
        const double turn = std::remainder(model.angles_rad[static_cast<std::size_t>(seen.view)] - first, 2 * kPi);
        low = std::min(low, turn);
        high = std::max(high, turn);
    }
    return high - low;
}

template <class Condition>
void filter_tracks(Bundle& bundle, Condition condition) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < bundle.tracks.size(); ++i) {
        if (!condition(i)) continue;
        if (kept != i) {
            bundle.tracks[kept] = std::move(bundle.tracks[i]);
            bundle.points[kept] = bundle.points[i];
        }
        ++kept;
    }
    bundle.tracks.resize(kept);
    bundle.points.resize(kept);
}

// Drops tracks over short arcs if enough others exist: they may be crossings of two contours or shadow edges, which
// move over the object but look like a point for a short time.
void drop_short_arcs(Bundle& bundle) {
    std::vector<double> arcs;
    for (const Track& track : bundle.tracks) arcs.push_back(arc_rad(bundle.model, track));
    std::vector<double> sorted = arcs;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    if (sorted.size() <= kEnoughWideTracks) return;
    filter_tracks(bundle, [&, least = std::min(kWideArc_rad, sorted[kEnoughWideTracks])](std::size_t i) {
        return arcs[i] >= least;
    });
}

// Limits the number of tracks by an even selection; the longest alone would be those with oblique views.
void limit_track_count(Bundle& bundle) {
    const std::size_t count = bundle.tracks.size();
    if (count <= kEnoughTracks) return;
    filter_tracks(bundle, [&](std::size_t i) { return i * kEnoughTracks / count != (i + 1) * kEnoughTracks / count; });
}

// Refines all points by patch alignment, and adds points beside them until there are `most` observations; sets the loss
// in `options` to fit the residuals. Nothing if the adjustment fails.
std::optional<Bundle> refine_by_alignment(Bundle bundle, const TurnImages& turn, BundleOptions& options, int most) {
    for (int round = 0; round < kMostAlignmentRounds; ++round) {
        const std::size_t known = bundle.tracks.size();
        grow_patches(bundle, turn.reduction, most);
        if (round >= kAlignmentRounds && bundle.tracks.size() == known) break;
        const std::vector<Track> tracks = align_tracks(turn.images, turn.reduction, bundle, known);
        bundle = make_robust_bundle(bundle.model, tracks, kAlignedLimit_px * turn.reduction);
        drop_short_arcs(bundle);
        for (int again = 0; again < 2; ++again) {
            options.loss_px = std::max(0.05 * turn.reduction, kLossDeviations * robust_deviation_px(bundle));
            if (!adjust(bundle, rough_options(options))) return std::nullopt;
            drop_outliers(bundle,
                          std::max(0.2 * turn.reduction, kTrackOutlierDeviations * robust_deviation_px(bundle)));
        }
    }
    if (!adjust(bundle, options)) return std::nullopt;
    return bundle;
}

// Held-out tracks, with points and outliers determined as for the used tracks; the model is constant.
Bundle evaluate_held_out(const TurntableModel& model, const Bundle& unseen, const TurnImages& turn, bool aligned) {
    Bundle bundle = make_robust_bundle(model, unseen.tracks, outlier_limit(unseen, turn.reduction));
    if (!aligned) return bundle;
    BundleOptions held;
    held.free = {.f = false, .pan = false, .tilt = false, .roll = false, .angles = AngleFreedom::kConstant};
    return refine_by_alignment(bundle, turn, held, 0).value_or(bundle);
}

// A bundle and the options of its last adjustment.
struct AdjustedBundle {
    Bundle bundle;
    BundleOptions options;
};

// First solution, from the detected features; accurate enough for plausibility checks.
Result<AdjustedBundle> solve_initial_bundle(std::span<const Track> tracks, std::span<const MatchedPair> pairs,
                                            const TurnImages& turn, const KnownInputs& known, Progress* progress) {
    const auto start =
        find_initial_model(tracks, pairs, static_cast<int>(turn.images.size()), known_lens(turn, known), known);
    if (!start) return Error{"no turn of equal steps explains how the object's points move"};
    if (progress != nullptr) progress->advance();
    AdjustedBundle found;
    found.options.free = free_parameters_beside(known);
    found.bundle = make_robust_bundle(start->model, tracks, 4.0 * turn.reduction);
    if (!adjust_robustly(found.bundle, tracks, turn.reduction, !known.distortion, found.options))
        return Error{kNoSolution};
    choose_axis_direction(found.bundle);
    if (progress != nullptr) progress->advance();
    return found;
}

struct RefinedBundle {
    AdjustedBundle used;
    Bundle held_out;          // tracks that took no part, by the model of the guided matches
    bool is_aligned = false;  // refined by patch alignment; else the first solution, adjusted accurately
};

// Repeats the solution with the additional tracks that guided matching finds around an approximate model, and refines
// it by patch alignment.
Result<RefinedBundle> refine_with_guided_matches(const PointTracker& tracker, const AdjustedBundle& initial,
                                                 const TurnImages& turn, const KnownInputs& known) {
    RS_ASSIGN_OR_RETURN(const std::vector<Track> guided,
                        tracker.track_guided(initial.bundle.model, kRadiusMargin * farthest_radius(initial.bundle),
                                             2.0 * turn.reduction));
    std::vector<Track> part, held_out;
    split(guided, part, held_out);
    RefinedBundle refined;
    auto& [bundle, options] = refined.used;
    bundle = make_robust_bundle(initial.bundle.model, part, outlier_limit(initial.bundle, turn.reduction));
    options = initial.options;
    if (!adjust_robustly(bundle, part, turn.reduction, !known.distortion, options)) return Error{kNoSolution};
    refined.held_out = make_robust_bundle(bundle.model, held_out, outlier_limit(bundle, turn.reduction));
    limit_track_count(bundle);
    std::optional<Bundle> finest =
        refine_by_alignment(bundle, turn, options, kObservationsPerView * static_cast<int>(turn.images.size()));
    refined.is_aligned = finest && finest->tracks.size() >= kFewestTracks / 2;
    if (refined.is_aligned) {
        bundle = *std::move(finest);
    } else {
        refined.used = initial;
        if (!adjust(bundle, options)) return Error{kNoSolution};
    }
    return refined;
}

// Adds the covariance to an adjusted bundle, for the refinement by silhouettes.
TrackSolution solution_with_covariance(AdjustedBundle adjusted, const TurnImages& turn, double at_px) {
    const BundleOptions& options = adjusted.options;
    TrackSolution solution{std::move(adjusted.bundle),
                           ParameterIndices(options.free, std::vector<bool>(turn.images.size(), true)),
                           {},
                           at_px,
                           {}};
    solution.covariance = bundle_covariance(solution.bundle, options, kSharedError_px * turn.reduction);
    solution.deviations = standard_deviations(solution.bundle.model, solution.places, solution.covariance, at_px);
    return solution;
}

// Result without warnings; `held_out` are the tracks that took no part, at the solution's model.
Calibration calibration_of(const TrackSolution& solution, const Bundle& held_out) {
    const Bundle& bundle = solution.bundle;
    Calibration calibration;
    calibration.method = CalibrationMethod::kTracks;
    calibration.model = bundle.model;
    calibration.deviations = solution.deviations;
    calibration.step_rad = median_step(bundle.model.angles_rad);
    calibration.points = static_cast<int>(bundle.tracks.size());
    calibration.observations = observation_count(bundle);
    calibration.rms_px = rms_px(bundle);
    calibration.held_out_rms_px = rms_px(held_out);
    calibration.views = view_fits(bundle);
    return calibration;
}

// Calibrates for a fixed camera. If the points are explained neither by a turn nor by a tripod that was moved once,
// `placed` becomes the best turn with images shifted and scaled individually. `placed` is null if that has already been
// undone.
Result<TrackCalibration> calibrate_fixed_images(const TurnImages& turn, const KnownInputs& known, Progress* progress,
                                                std::optional<PlacementEstimate>* placed) {
    const std::size_t views = turn.images.size();
    if (views < kFewestViews) {
        return Error{std::to_string(views) + " images are too few to calibrate a turn; take at least " +
                     std::to_string(kFewestViews) + ", better 36"};
    }
    if (progress != nullptr) progress->start("tracking points", 2 * static_cast<std::int64_t>(views));
    RS_ASSIGN_OR_RETURN(const PointTracker tracker, PointTracker::detect(turn.images, turn.reduction, {}, progress));
    RS_ASSIGN_OR_RETURN(TrackedPoints tracked, tracker.track(progress));
    if (tracked.tracks.size() < kFewestTracks) {
        return Error{"only " + std::to_string(tracked.tracks.size()) +
                     " points of the object can be tracked over three or more images; an object with so little "
                     "texture needs a board under it (rs-capture board)"};
    }
    std::vector<Track> part, held_out;
    split(tracked.tracks, part, held_out);

    if (progress != nullptr) progress->start("solving for axis, lens and angles", 3);
    RS_ASSIGN_OR_RETURN(const AdjustedBundle initial, solve_initial_bundle(part, tracked.pairs, turn, known, progress));
    const double at_px = 0.5 * (has_sideways_axis(initial.bundle.model.pose) ? turn.width : turn.height);
    const std::vector<int> candidates = observations_per_view(part, views);
    Status accepted = check_plausibility(
        initial.bundle, bundle_standard_deviations(initial.bundle, initial.options, at_px), candidates, turn.names);
    if (!accepted) {
        if (placed != nullptr && !has_single_change(initial.bundle, candidates)) {
            *placed = estimate_placements(tracked.tracks, known_lens(turn, known), views, turn.reduction, known);
        }
        return accepted.error();
    }
    RS_ASSIGN_OR_RETURN(RefinedBundle refined, refine_with_guided_matches(tracker, initial, turn, known));
    TrackSolution solution = solution_with_covariance(std::move(refined.used), turn, at_px);
    const auto axis_disagrees = refine_with_silhouettes(solution, turn, kFewestTracks / 2);
    if (progress != nullptr) progress->advance();

    const TurntableModel& model = solution.bundle.model;
    Calibration calibration =
        calibration_of(solution, evaluate_held_out(model, refined.held_out, turn, refined.is_aligned));
    // Angles and axis of images that were shifted individually depend on the estimated placements, so no warnings about
    // them.
    if (placed != nullptr) {
        calibration.warnings = step_warnings(model.angles_rad, calibration.deviations, turn.names);
        if (axis_disagrees) calibration.warnings.push_back(*axis_disagrees);
    }
    Bundle judged = initial.bundle;  // the observations of the features with the refined model
    judged.model = model;
    const auto of_images = image_warnings(judged, candidates, tracked.features, turn.names);
    calibration.warnings.insert(calibration.warnings.end(), of_images.begin(), of_images.end());
    return TrackCalibration{std::move(calibration), std::move(tracked), std::move(solution.bundle)};
}

Result<TrackCalibration> calibrate_placed(const TurnImages& turn, const KnownInputs& known, Progress* progress) {
    std::optional<PlacementEstimate> placed;
    Result<TrackCalibration> still = calibrate_fixed_images(turn, known, progress, &placed);
    if (!placed || placed->agreeing < kFewestAgreeingPlaced) return still;
    std::vector<ImagePlacement> places = std::move(placed->places);
    for (int round = 0;; ++round) {
        Result<TrackCalibration> found =
            calibrate_fixed_images(undo_placements(turn, places), known, progress, nullptr);
        if (!found) return still;
        found->calibration.places = places;
        const auto remaining =
            round < kPlaceRounds ? estimate_remaining_placements(found->bundle, turn.reduction, known) : std::nullopt;
        if (!remaining) {
            found->calibration.warnings.push_back(place_warning(places));
            return found;
        }
        for (std::size_t i = 0; i < places.size(); ++i) places[i] = places[i].of((*remaining)[i]);
    }
}

// True if the distortion folds the image over itself. No real lens does; the distortion then fits another effect.
bool folds_image(const Lens& lens) {
    for (const double x : {0.0, static_cast<double>(lens.width)}) {
        for (const double y : {0.0, static_cast<double>(lens.height)}) {
            if (!undistorted(lens, {x, y})) return true;
        }
    }
    return false;
}

}  // namespace

Result<TrackCalibration> calibrate_with_tracks(const TurnImages& turn, const KnownInputs& known, Progress* progress) {
    Result<TrackCalibration> found = calibrate_placed(turn, known, progress);
    if (!found || known.distortion || !folds_image(found->calibration.model.lens)) return found;
    KnownInputs straight = known;
    straight.distortion = glm::dvec2(0);
    found = calibrate_placed(turn, straight, progress);
    if (found) {
        found->calibration.warnings.emplace_back(
            "the object's points do not determine the lens distortion, so none is assumed; give known values with "
            "--known FILE");
    }
    return found;
}

}  // namespace rs::capture
