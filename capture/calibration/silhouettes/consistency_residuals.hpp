#pragma once
// Consistency of silhouettes with a turntable model. A ray through a point of a silhouette touches the object, so
// somewhere along it there is a point within the silhouettes of all views. The residual of the ray is the distance in
// px by which its best point is outside of them; it is 0 for the true model (after Hernandez, Schmitt, Cipolla,
// "Silhouette coherence for camera calibration under circular motion", 2007).

#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/silhouettes/silhouette_turn.hpp"

#include <vector>

namespace rs::capture {

struct RaySelection {
    std::size_t every = 1;       // every n-th edge point of a view
    std::vector<char> left_out;  // [view]: views excluded with their rays and silhouettes; empty: none
};

/// Depth of each ray's best point, in distances from the camera.
using RayDepths = std::vector<double>;

/// The residual of each selected ray, >= 0, view by view in the order of SilhouetteTurn::edges(); rays that do not
/// exist because of the lens distortion have a large constant residual. `model` is in px of `turn` and has an angle for
/// each of its views. Runs on the calling tbb arena; the result does not depend on the number of threads. About 10 ms
/// for 36 views on 2 cores. `depths`, if given and empty, is filled in; otherwise it must be of a similar model, and
/// only depths near it are searched, in a third of the time.
std::vector<double> consistency_residuals_px(const SilhouetteTurn& turn, const TurntableModel& model,
                                             const RaySelection& rays, RayDepths* depths = nullptr);

/// The depth that determines a ray's residual, and the few views that contradict the ray the most there.
struct RayContradictions {
    double depth = 0;                // 0: there is no ray
    std::vector<std::size_t> views;  // in descending order of contradiction
};

/// Verdicts for the residuals of `model`, searched near `depths`. The views are those within `margin_px` of the
/// strongest contradiction, at most `most`.
std::vector<RayContradictions> find_contradictions(const SilhouetteTurn& turn, const TurntableModel& model,
                                                   const RaySelection& rays, const RayDepths& depths, double margin_px,
                                                   std::size_t most);

/// Residuals of a model similar to that of the verdicts, computed from the verdicts' views near their depths only, in a
/// tenth of the time.
std::vector<double> residuals_from_contradictions(const SilhouetteTurn& turn, const TurntableModel& model,
                                                  const RaySelection& rays,
                                                  const std::vector<RayContradictions>& verdicts);

/// Root mean square; 0 if empty.
double rms_px(const std::vector<double>& residuals);

/// The view of each residual, in the same order.
std::vector<std::size_t> views_of_rays(const SilhouetteTurn& turn, const RaySelection& rays);

}  // namespace rs::capture
