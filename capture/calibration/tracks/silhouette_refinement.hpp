#pragma once
// Refines the solution of the tracks with the silhouettes of the turn: first the axis, by the symmetry of the region
// that all views cover together (silhouette_symmetry.hpp), then all numbers, by pairs of views
// (silhouette_tangency.hpp) and by all views at once (coherence_fit.hpp).

#include "capture/calibration/points/bundle.hpp"
#include "capture/calibration/points/model_covariance.hpp"
#include "capture/calibration/tracks/track_calibration.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>

namespace rs::capture {

struct TrackSolution {
    Bundle bundle;
    ParameterIndices places;
    Eigen::MatrixXd covariance;  // of the numbers at `places`; empty if unknown
    double at_px = 0;            // row (column for a sideways axis) at which the axis' position is evaluated
    ModelDeviations deviations;
};

/// Numbers that silhouettes do not determine, or on which they are not consistent, stay as they are; a step that would
/// leave fewer than `fewest_tracks` tracks is not applied. Returns a warning if tracks and silhouettes disagree on the
/// axis. Runs on the calling tbb arena; deterministic.
std::optional<std::string> refine_with_silhouettes(TrackSolution& solution, const TurnImages& turn,
                                                   std::size_t fewest_tracks);

}  // namespace rs::capture
