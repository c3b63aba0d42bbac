#pragma once
// From the covariance of a turn's unknown numbers, however it was found, to the deviations that are reported.

#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/points/bundle.hpp"
#include "capture/calibration/points/reprojection.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace rs::capture {

// Where the numbers of a model stand among the unknowns, camera first, then angles or the step; -1: held.
struct NumberPlaces {
    std::array<int, kCameraNumbers> camera{};
    std::vector<int> angles;  // [view]; the first view's is held always, and where a common step is sought all are
    int step = -1;
    int count = 0;

    // is_seen[view]: a view that nothing is seen in keeps its angle.
    NumberPlaces(const BundleFreedom& free, const std::vector<bool>& is_seen);
};

// `model` with the numbers at `places` changed by `step`.
TurntableModel stepped(TurntableModel model, const NumberPlaces& places, const Eigen::VectorXd& step);

// What was held has a deviation of 0; all are infinite where `covariance` is empty, for nothing is known. Unknowns of
// `covariance` beyond places.count do not count. `at_px` is the row (for an axis nearer to sideways the column) at
// which the axis' position is judged.
ModelDeviations deviations_of(const TurntableModel& model, const NumberPlaces& places,
                              const Eigen::MatrixXd& covariance, double at_px);

// How sure the numbers of a bundle are.
//
// Points are eliminated, and of what is left three kinds of error are added up.
//   - Of each track by itself: the robust "sandwich" H^-1 M H^-1 (Huber 1967, White 1980), M the sum over tracks of the
//     outer product of what their observations show together, for a feature that is placed a little wrong is so in all
//     views. H is how firmly the robust loss holds: far observations hardly do.
//   - Of each side of the object: features near each other err alike, since the same shadow glides over them, and fur
//     and petals seem to turn a little faster than they do. The turn is cut into twelve sectors, each of which errs as
//     one. The numbers follow the errors of a sector, so its residuals hide a part of them: what a sector does is what
//     the others would find without it (a jackknife over groups; Bell and McCaffrey 2002).
//   - Of all tracks alike, which no residual shows: where surfaces bend away, and where light glides over them, what
//     looks like a point moves a little, and the same way on every side. `shared_error_px` is the size of that: the
//     standard deviation of each of four movements, across and along the image, in proportion to the sine and to one
//     less the cosine of the angle by which a view lies beside the middle of those that see the point.
// Counting observations as independent (s^2 H^-1) would promise two to five times too much.

// Of the free numbers, in the order of NumberPlaces (model_covariance.hpp), every view being seen; empty where
// there are no more tracks than numbers, or they do not determine them.
Eigen::MatrixXd bundle_covariance(const Bundle& bundle, const BundleOptions& options, double shared_error_px = 0);

// At the optimum that adjust() found with the same options. What was held has a deviation of 0. `at_px` is the row (for
// an axis nearer to sideways the column) at which the axis' position is judged. All infinite where the observations do
// not determine the free numbers.
ModelDeviations bundle_deviations(const Bundle& bundle, const BundleOptions& options, double at_px,
                                  double shared_error_px = 0);

}  // namespace rs::capture
