#pragma once
// Constrains camera and angles by pairs of silhouettes: the planes through both camera centres that are tangent to the
// object are the same in both views.
//
// In the object's frame, the camera moves around the object. Of the pencil of planes through two of its positions, the
// two outermost that touch the object are tangent to both silhouettes, at frontier points (Wong and Cipolla, "Structure
// and motion from silhouettes", 2001); the residual is the angle between the planes of the two views. No texture is
// used, so moving highlights and shadows do not bias the result as they do with points. Only the convex hulls of the
// silhouettes matter: holes and concavities may be segmented wrongly.

#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/points/model_covariance.hpp"
#include "capture/calibration/points/tracks.hpp"

#include <Eigen/Core>
#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace rs::capture {

/// Vertices of the convex hull of a view's silhouette, px of the photo, with subpixel accuracy. Empty if the view is
/// empty or its object is cut off by the image border.
using SilhouetteHull = std::vector<glm::dvec2>;

/// [view]; `turn` is reduced by `reduction`. `model` is only used to undistort: hulls are convex without distortion.
std::vector<SilhouetteHull> silhouette_hulls(std::span<const CalibrationImage> turn, int reduction,
                                             const TurntableModel& model);

struct ViewPair {
    std::size_t first = 0;
    std::size_t second = 0;
};

/// The pairs of views with hulls that are neither too near to each other nor opposite.
std::vector<ViewPair> comparable_views(const TurntableModel& model, std::span<const SilhouetteHull> hulls);

/// Distance between the tangent planes of two views, px in the photos: two values per pair, 0 if the object is not
/// between the two planes in both views.
std::vector<double> tangency_residuals(const TurntableModel& model, std::span<const SilhouetteHull> hulls,
                                       std::span<const ViewPair> pairs);

struct TangencyFit {
    TurntableModel model;
    Eigen::MatrixXd covariance;  // of the numbers at `places`, like the input
    double deviation_px = 0;     // robust standard deviation of a residual
};

/// Least-squares combination of `model`, with `covariance` of the numbers at `places`, and the silhouettes, which are
/// weighted by their final residuals. If the silhouettes move lens and orientation by more deviations than `covariance`
/// allows, it is scaled until they agree (Birge 1932), because its source had an unknown error. Numbers with zero
/// variance stay constant, for example the angle of a view without points.
/// Nothing if fewer than 60 tangencies can be compared, if their deviation stays above `worst_px`, or if the model
/// degenerates. Single-threaded; deterministic.
std::optional<TangencyFit> fit_tangency(const TurntableModel& model, const ParameterIndices& places,
                                        const Eigen::MatrixXd& covariance, std::span<const SilhouetteHull> hulls,
                                        double worst_px);

}  // namespace rs::capture
