#pragma once
// What the outlines of all views together show of camera and angles: that they are outlines of one body
// (consistency_residuals.hpp). Points that can be followed for a short way only let the angles drift around the turn;
// outlines tie every view to all others.

#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/points/model_covariance.hpp"
#include "capture/calibration/silhouettes/silhouette_turn.hpp"

#include <Eigen/Core>

#include <optional>

namespace rs::capture {

struct CoherenceFit {
    TurntableModel model;
    Eigen::MatrixXd covariance;          // as the one given
    double consistency_residual_px = 0;  // root mean square over the rays, px of the photographs
};

struct CoherenceOptions {
    double worst_px = 0.5;     // of the photographs: outlines that come to agree no better are left out
    int most_directions = 14;  // combinations of numbers that are looked at; the work grows with them
    // Outlines err together in ways no residual shows: they are taken to be off by so many times what they show.
    double untold_together = 6;
    // Begins with a hundred rays of a view: four times as quick where `model` is nearly right. From afar so few lead
    // astray: a body of revolution then seems to show its angles.
    bool few_rays_first = false;
};

// `model`, known with `covariance` of the numbers at `places`, and the outlines together: what both make likeliest,
// along those combinations of numbers that `covariance` leaves loosest. Outlines are weighed by how well they agree.
// `image_px`: px of the photographs per px of `turn`. Nothing where the outlines do not come to agree within
// worst_px, where they show little of the angles (a body of revolution, angles that are held), or
// where `model` does not stay before the camera. Works on the threads of the calling tbb
// arena; equal results whatever their number.
std::optional<CoherenceFit> fit_coherence(const TurntableModel& model, const NumberPlaces& places,
                                          const Eigen::MatrixXd& covariance, const SilhouetteTurn& turn,
                                          double image_px, const CoherenceOptions& options);

}  // namespace rs::capture
