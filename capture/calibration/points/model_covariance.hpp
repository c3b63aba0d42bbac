#pragma once
// Converts the covariance of a turn's unknowns to the standard deviations that are reported.

#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/points/bundle.hpp"
#include "capture/calibration/points/reprojection.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace rs::capture {

/// Indices of a model's numbers among the unknowns, camera first, then angles or the step; -1: held constant.
struct ParameterIndices {
    std::array<int, kCameraParameters> camera{};
    std::vector<int> angles;  // [view]; -1 for the first view always, and for all views if a common step is estimated
    int step = -1;
    int count = 0;

    /// is_seen[view]: the angle of a view without observations is held constant.
    ParameterIndices(const BundleFreedom& free, const std::vector<bool>& is_seen);
};

/// `model` with `step` added to the numbers at `places`.
TurntableModel apply_step(TurntableModel model, const ParameterIndices& places, const Eigen::VectorXd& step);

/// Deviations are 0 for constants, and all are infinite if `covariance` is empty. Unknowns of `covariance` beyond
/// places.count are ignored. `at_px` is the row (column for a sideways axis) at which the axis' position is evaluated.
ModelDeviations standard_deviations(const TurntableModel& model, const ParameterIndices& places,
                                    const Eigen::MatrixXd& covariance, double at_px);

// Covariance of a bundle.
//
// Points are eliminated, and three kinds of error are added:
//   - Errors of individual tracks: the robust "sandwich" estimate H^-1 M H^-1 (Huber 1967, White 1980), M the sum over
//   tracks of the outer product of their scores, because a feature that is localized a little wrong is so in all views.
//   H is the curvature of the robust loss, to which far observations hardly contribute.
//   - Errors of one side of the object: nearby features have correlated errors, because the same shadow moves over
//   them, and fur and petals seem to turn a little faster than they do. The turn is divided into twelve sectors with
//   one common error each. The estimate follows the errors of a sector, so its residuals hide part of them; a sector's
//   influence is computed from the solution of the other sectors (a jackknife over groups; Bell and McCaffrey 2002).
//   - Errors common to all tracks, which no residual shows: near occluding contours and under moving highlights,
//   apparent points move a little, in the same way on every side. `shared_error_px` is their size: the standard
//   deviation of each of four movements, across and along the image, proportional to the sine and to one minus the
//   cosine of the angle between a view and the middle of the views that see the point.
// Treating observations as independent (s^2 H^-1) would underestimate the deviations by a factor of two to five.

/// Covariance of the free numbers, in the order of ParameterIndices (model_covariance.hpp), every view being seen;
/// empty if there are no more tracks than numbers, or the tracks do not determine them.
Eigen::MatrixXd bundle_covariance(const Bundle& bundle, const BundleOptions& options, double shared_error_px = 0);

/// Deviations at the optimum that adjust() found with the same options; 0 for constants. `at_px` is the row (column for
/// a sideways axis) at which the axis' position is evaluated. All are infinite if the observations do not determine the
/// free numbers.
ModelDeviations bundle_standard_deviations(const Bundle& bundle, const BundleOptions& options, double at_px,
                                           double shared_error_px = 0);

}  // namespace rs::capture
