#pragma once
// How well outlines agree with a turntable model. A ray through a point of an outline touches the object, so somewhere
// along it there is a point that lies within the outlines of all views. How much the best point of the ray lacks of
// that, in px, is the ray's residual; it is 0 for the true model (after Hernandez, Schmitt, Cipolla, "Silhouette
// coherence for camera calibration under circular motion", 2007).

#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/silhouettes/silhouette_turn.hpp"

#include <vector>

namespace rs::capture {

struct RaySelection {
    std::size_t every = 1;       // every n-th edge point of a view
    std::vector<char> left_out;  // [view]: neither rays nor outlines of it count; empty: none
};

// Where along its ray each residual was found, in distances from the camera.
using RayDepths = std::vector<double>;

// The residual of each selected ray, 0 and more, view by view in the order of SilhouetteTurn::edges(); rays that the
// model does not have (lens distortion) fall short by a fixed large amount. `model` is in px of `turn` and has an angle
// for each of its views. Works on the threads of the calling tbb arena; equal results whatever their number. About 10
// ms for 36 views on 2 cores. `depths`, where given: if empty it is filled in; else it is of a model that differs
// little, and rays are only looked at near there, in a third of the time.
std::vector<double> consistency_residuals_px(const SilhouetteTurn& turn, const TurntableModel& model,
                                             const RaySelection& rays, RayDepths* depths = nullptr);

// What decides a residual: where along its ray it was found, and the few views that contradict the ray the most there.
struct RayVerdict {
    double depth = 0;                // 0: there is no ray
    std::vector<std::size_t> views;  // the strongest first
};

// Of each residual of `model`, found near `depths`. The views are those within `margin_px` of the strongest, at most
// `most`.
std::vector<RayVerdict> ray_verdicts(const SilhouetteTurn& turn, const TurntableModel& model, const RaySelection& rays,
                                     const RayDepths& depths, double margin_px, std::size_t most);

// The residuals of a model that differs little from the verdicts': what the verdicts' views alone make them near
// their depths, in a tenth of the time.
std::vector<double> residuals_by_verdicts(const SilhouetteTurn& turn, const TurntableModel& model,
                                          const RaySelection& rays, const std::vector<RayVerdict>& verdicts);

// Root mean square; 0 of none.
double rms_px(const std::vector<double>& residuals);

// The views that the residuals belong to, in the same order.
std::vector<std::size_t> views_of_rays(const SilhouetteTurn& turn, const RaySelection& rays);

}  // namespace rs::capture
