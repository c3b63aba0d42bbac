#pragma once
// What the outlines of any two views show of camera and angles: the planes through both camera centres that just
// touch the object are the same, whichever of the two views one looks from.
//
// The camera goes around the object in the object's frame. Of the pencil of planes through two of its places the two
// outermost that touch the object are tangent to both outlines, at frontier points (Wong and Cipolla, "Structure and
// motion from silhouettes", 2001); what they are off each other is the residual. No texture takes part, so whatever
// glides over a surface as it turns misleads points but not this. Only the hulls of the outlines matter: holes and
// hollows may be cut out wrong.

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

// The corners of the convex hull of what a view covers, px of the photograph, to a part of a pixel. Empty where the
// view is empty or its object is cut off by the image's border.
using SilhouetteHull = std::vector<glm::dvec2>;

// [view]; `turn` reduced by `reduction`. `model` only undoes the lens: hulls are convex without its distortion.
std::vector<SilhouetteHull> silhouette_hulls(std::span<const CalibrationImage> turn, int reduction,
                                             const TurntableModel& model);

struct ViewPair {
    std::size_t first = 0;
    std::size_t second = 0;
};

// The pairs of views with hulls that are neither too near to each other nor opposite.
std::vector<ViewPair> comparable_views(const TurntableModel& model, std::span<const SilhouetteHull> hulls);

// By how much the tangent planes of two views stand apart, px as seen in the photographs: two numbers per pair, 0 where
// the object is not between the two planes that both see.
std::vector<double> tangency_residuals(const TurntableModel& model, std::span<const SilhouetteHull> hulls,
                                       std::span<const ViewPair> pairs);

struct TangencyFit {
    TurntableModel model;
    Eigen::MatrixXd covariance;  // as the one given
    double deviation_px = 0;     // of a residual, robust
};

// `model`, known with `covariance` of the numbers at `places`, and the outlines together: the least squares of both.
// Outlines are weighed by how well they agree in the end. Where they move lens and directions by more deviations than
// `covariance` allows, it is widened until it does (Birge 1932): what it came from erred in a way it did not know of.
// Numbers of no variance stay, as the angle of a view in which no point was seen.
// Nothing where fewer than 60 tangencies can be compared, where they do not come to agree within `worst_px`, or where
// `model` does not stay before the camera. One thread; deterministic.
std::optional<TangencyFit> fit_tangency(const TurntableModel& model, const NumberPlaces& places,
                                        const Eigen::MatrixXd& covariance, std::span<const SilhouetteHull> hulls,
                                        double worst_px);

}  // namespace rs::capture
