#pragma once
// Refines camera and angles by silhouette consistency: the silhouettes of all views must be those of one body
// (consistency_residuals.hpp). With points that can only be tracked over short arcs, angles drift around the turn;
// silhouettes constrain every view against all others.

#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/points/model_covariance.hpp"
#include "capture/calibration/silhouettes/silhouette_turn.hpp"

#include <Eigen/Core>

#include <optional>

namespace rs::capture {

struct CoherenceFit {
    TurntableModel model;
    Eigen::MatrixXd covariance;          // of the numbers at `places`, like the input
    double consistency_residual_px = 0;  // root mean square over the rays, px of the photos
};

struct CoherenceOptions {
    double worst_px = 0.5;     // of the photos: a fit with larger residuals is rejected
    int most_directions = 14;  // number of combinations of numbers that are estimated; the cost grows with it
    /// Factor of silhouette errors that are common to all views and invisible in the residuals, relative to the stated
    /// errors.
    double common_error_factor = 6;
    /// Starts with a hundred rays per view: four times as fast if `model` is nearly right. Far from the optimum so few
    /// rays mislead: a body of revolution then seems to determine its angles.
    bool few_rays_first = false;
};

/// Maximum of the joint likelihood of `model`, with `covariance` of the numbers at `places`, and the silhouettes, along
/// the combinations of numbers with the largest variance. Silhouettes are weighted by their consistency. `image_px`: px
/// of the photos per px of `turn`. Returns nothing if the residuals stay above worst_px, if the silhouettes hardly
/// determine the angles (a body of revolution, constant angles), or if the model degenerates. Runs on the calling tbb
/// arena; the result does not depend on the number of threads.
std::optional<CoherenceFit> fit_coherence(const TurntableModel& model, const ParameterIndices& places,
                                          const Eigen::MatrixXd& covariance, const SilhouetteTurn& turn,
                                          double image_px, const CoherenceOptions& options);

}  // namespace rs::capture
