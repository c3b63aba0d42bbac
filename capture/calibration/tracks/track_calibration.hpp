#pragma once
// Calibration of a turn from object points: start search, bundle adjustment, outlier rejection, hold-out, plausibility
// checks. The silhouettes of a full turn refine the result (silhouette_refinement.hpp). If no turn before a fixed
// camera explains the points, the images are assumed to be shifted and scaled individually, and this is undone
// (placement_estimation.hpp). If the best lens folds its own image over, calibration is repeated without distortion.

#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/points/bundle.hpp"
#include "capture/calibration/points/tracks.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

namespace rs::capture {

struct TrackCalibration {
    Calibration calibration;
    TrackedPoints tracked;  // positions in px of the photos, with their placements undone
    Bundle bundle;          // the tracks that took part, at the optimum except for the silhouette refinement
};

/// Fails, with advice for the photographer, if the images do not determine a single-axis motion: too few points, too
/// little overlap between neighbours, points that disagree (two cameras, a moved tripod), angles that are not a turn.
/// Not reentrant; uses all cores.
Result<TrackCalibration> calibrate_with_tracks(const TurnImages& turn, const KnownInputs& known, Progress* progress);

}  // namespace rs::capture
