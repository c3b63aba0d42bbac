#pragma once
// How sure the numbers of a bundle are.
//
// The covariance is the robust "sandwich" H^-1 M H^-1 (Huber 1967, White 1980): H the Gauss-Newton matrix after the
// points are eliminated, M the sum over *tracks* of the outer product of what each track says. The errors of one track
// are alike, since a feature that is placed a little wrong is so in all views, so counting observations as independent
// (s^2 H^-1) would promise too much.

#include "capture/calibration/bundle.hpp"
#include "capture/calibration/calibration.hpp"

namespace rs::capture {

// At the optimum that adjust() found with the same options. What was held has a deviation of 0. `at_px` is the row (for
// an axis nearer to sideways the column) at which the axis' position is judged. All infinite where the observations do
// not determine the free numbers.
ModelDeviations bundle_deviations(const Bundle& bundle, const BundleOptions& options, double at_px);

// An axis nearer to sideways than to upright in the picture.
bool lies_sideways(const CameraPose& pose);

}  // namespace rs::capture
