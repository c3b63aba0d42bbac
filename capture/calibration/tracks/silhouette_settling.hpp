#pragma once
// What points alone have solved, brought to where the outlines of the turn see it too: first the axis, by the symmetry
// of what all views cover together (silhouette_symmetry.hpp), then all numbers, by pairs of views
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
    NumberPlaces places;
    Eigen::MatrixXd covariance;  // of the numbers at `places`; empty where it is not known
    double at_px = 0;            // row (column for an axis that lies sideways) at which the axis' position is judged
    ModelDeviations deviations;
};

// Whatever outlines cannot show, or do not agree on, stays as it is, and so does a step that would leave fewer than
// `fewest_tracks`. The value is a line for the photographer where axis and outlines disagree. Works on the threads of
// the calling tbb arena; deterministic.
std::optional<std::string> settle_with_silhouettes(TrackSolution& solution, const TurnImages& turn,
                                                   std::size_t fewest_tracks);

}  // namespace rs::capture
