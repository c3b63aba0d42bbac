#include "capture/calibration/tracks/silhouette_refinement.hpp"

#include "capture/calibration/silhouettes/coherence_fit.hpp"
#include "capture/calibration/silhouettes/silhouette_symmetry.hpp"
#include "capture/calibration/silhouettes/silhouette_tangency.hpp"
#include "capture/calibration/silhouettes/silhouette_turn.hpp"
#include "capture/calibration/silhouettes/turn_diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

// Silhouette pairs that agree less are of fur, or segmented wrongly, and would mislead.
constexpr double kWorstPairs_px = 0.15;
constexpr double kWorstTogether_px = 0.5;  // of all views; silhouettes of real photos deviate by 0.3

// Applies the model and triangulates the points again; returns false if fewer than `fewest_tracks` remain.
bool apply_model(const TurntableModel& model, Bundle& bundle, std::size_t fewest_tracks) {
    Bundle moved = make_bundle(model, bundle.tracks);
    if (moved.tracks.size() < fewest_tracks) return false;
    bundle = std::move(moved);
    return true;
}

// Applies the result of a fit. The deviation of the axis' position does not decrease, because it was estimated from the
// same silhouettes before.
void apply_fit(const TurntableModel& model, const Eigen::MatrixXd& covariance, TrackSolution& solution,
               std::size_t fewest_tracks) {
    if (!apply_model(model, solution.bundle, fewest_tracks)) return;
    const double before_px = solution.deviations.axis_position_px;
    solution.deviations = standard_deviations(solution.bundle.model, solution.places, covariance, solution.at_px);
    solution.deviations.axis_position_px = std::max(solution.deviations.axis_position_px, before_px);
    solution.covariance = covariance;
}

// Moves the axis to the combined estimate of tracks and silhouettes, and triangulates the points again. Other numbers
// stay: texture that moves uniformly around the whole object seems to turn about an axis beside the true one, and
// changing lens and angles to fit the true one would only spread the error. Updates the deviation of the axis'
// position. Returns a warning if tracks and silhouettes disagree.
std::optional<std::string> refine_axis(TrackSolution& solution, const TurnImages& turn, std::size_t fewest_tracks) {
    const ParameterIndices& places = solution.places;
    if (places.camera[CameraParameter::kPan] < 0) return std::nullopt;
    const TurntableModel& found = solution.bundle.model;
    const auto of_silhouettes = axis_from_silhouettes(union_of_alphas(turn.images), turn.reduction, found);
    if (!of_silhouettes) return std::nullopt;
    const auto position = axis_position(found.lens, found.pose, of_silhouettes->at_px);
    if (!position) return std::nullopt;
    const double deviation_px =
        standard_deviations(found, places, solution.covariance, of_silhouettes->at_px).axis_position_px;
    const AxisPosition of_tracks{of_silhouettes->at_px, *position, deviation_px};
    const AxisPosition agreed = combine_axes(of_tracks, *of_silhouettes);
    const auto model = move_axis_to(found, agreed);
    if (!model || !apply_model(*model, solution.bundle, fewest_tracks)) return std::nullopt;
    ModelDeviations& deviations = solution.deviations;
    deviations.axis_position_px =
        std::hypot(agreed.deviation_px, deviations.roll_rad * (agreed.at_px - solution.at_px));
    return axis_warning(of_tracks, *of_silhouettes, turn.reduction);
}

// Moves the whole model to the combined estimate of tracks and silhouette pairs (silhouette_tangency.hpp), and
// triangulates the points again. The covariance is that of the tracks, with the axis' position replaced by its
// deviation.
void refine_by_pairs(TrackSolution& solution, const TurnImages& turn, std::size_t fewest_tracks) {
    Eigen::MatrixXd& covariance = solution.covariance;
    const TurntableModel& found = solution.bundle.model;
    if (const int pan = solution.places.camera[CameraParameter::kPan]; pan >= 0) {
        covariance.row(pan).setZero();
        covariance.col(pan).setZero();
        covariance(pan, pan) = std::pow(solution.deviations.axis_position_px / found.lens.f_px, 2);
    }
    const std::vector<SilhouetteHull> hulls = silhouette_hulls(turn.images, turn.reduction, found);
    const auto fit = fit_tangency(found, solution.places, covariance, hulls, kWorstPairs_px * turn.reduction);
    if (fit) apply_fit(fit->model, fit->covariance, solution, fewest_tracks);
}

// Resolution at which all silhouettes are compared: the cost grows with the square of the number of views.
SilhouetteDetail detail_of(std::size_t views) {
    const double fewer = std::min(1.0, 36.0 / static_cast<double>(views));
    return {views <= 72 ? 600 : 300, static_cast<std::size_t>(std::max(32.0, 400 * fewer * fewer))};
}

// The same with the silhouettes of all views together (coherence_fit.hpp).
void refine_by_all(TrackSolution& solution, const TurnImages& turn, std::size_t fewest_tracks) {
    std::vector<Image<std::uint8_t>> masks;
    for (const CalibrationImage& image : turn.images) masks.push_back(image.alpha);
    const auto silhouettes = SilhouetteTurn::create(masks, detail_of(masks.size()));
    if (!silhouettes || silhouettes->touches_border()) return;
    const double image_px = silhouettes->reduction() * turn.reduction;
    const auto fit = fit_coherence(solution.bundle.model, solution.places, solution.covariance, *silhouettes, image_px,
                                   {.worst_px = kWorstTogether_px * turn.reduction, .few_rays_first = true});
    if (fit) apply_fit(fit->model, fit->covariance, solution, fewest_tracks);
}

}  // namespace

std::optional<std::string> refine_with_silhouettes(TrackSolution& solution, const TurnImages& turn,
                                                   std::size_t fewest_tracks) {
    std::optional<std::string> axis_disagrees = refine_axis(solution, turn, fewest_tracks);
    if (solution.covariance.size() == 0) return axis_disagrees;
    refine_by_pairs(solution, turn, fewest_tracks);
    refine_by_all(solution, turn, fewest_tracks);
    return axis_disagrees;
}

}  // namespace rs::capture
