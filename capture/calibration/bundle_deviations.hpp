#pragma once
// How sure the numbers of a bundle are.
//
// The covariance is the robust "sandwich" H^-1 M H^-1 (Huber 1967, White 1980): H the Gauss-Newton matrix after the
// points are eliminated, M the sum over *neighbourhoods* of the outer product of what the tracks in each say together.
// The errors of one track are alike, since a feature that is placed a little wrong is so in all views, and so are those
// of its neighbours, over which the same shadow glides: counting observations as independent (s^2 H^-1) would promise
// two to five times too much.
//
// What is alike in all tracks no residual shows: where surfaces bend away, and where light glides over them, what looks
// like a point moves a little, and the same way on every side of the object. `shared_error_px` is the size of that: the
// standard deviation of each of four movements, across and along the picture, in proportion to the sine and to one less
// the cosine of the angle by which a view lies beside the middle of those that see the point. It is added to what the
// tracks themselves say.

#include "capture/calibration/bundle.hpp"
#include "capture/calibration/calibration.hpp"

#include <Eigen/Core>

namespace rs::capture {

// What is alike only in the tracks of one side of the object does not show in residuals either, for that side's angles
// follow it: fur and petals that seem to turn a little faster than they do. It is added in the same four movements, for
// each sector of the turn by itself, in proportion to how badly patches are explained there.
//
// Of the free numbers, in the order of NumberPlaces (model_covariance.hpp), every view being seen; empty where the
// observations do not determine them.
Eigen::MatrixXd bundle_covariance(const Bundle& bundle, const BundleOptions& options, double shared_error_px = 0);

// At the optimum that adjust() found with the same options. What was held has a deviation of 0. `at_px` is the row (for
// an axis nearer to sideways the column) at which the axis' position is judged. All infinite where the observations do
// not determine the free numbers.
ModelDeviations bundle_deviations(const Bundle& bundle, const BundleOptions& options, double at_px,
                                  double shared_error_px = 0);

}  // namespace rs::capture
