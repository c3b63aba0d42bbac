#pragma once
/// \file
/// Adjusts turns to the silhouettes of all of them: every point of a silhouette is on a ray that touches the object, so
/// the ray must pass through the silhouettes of all other views (as in
/// calibration/silhouettes/consistency_residuals.hpp for one turn).

#include "capture/calibration/points/tracks.hpp"
#include "capture/turns/turn_placement.hpp"
#include "rayspace/base/result.hpp"

#include <vector>

namespace rs::capture {

enum class SilhouetteFreedom {
    kFixed,      ///< nothing is estimated
    kPlacement,  ///< azimuth, distance and height
    kCamera,     ///< pose and focal length, which turns with kCamera share except for small deviations
    kAll,        ///< both
};

struct SilhouettesToFit {
    const TurnImages* images = nullptr;
    PlacedTurn turn;  ///< approximate; replaced by the result
    SilhouetteFreedom freedom = SilhouetteFreedom::kFixed;
    double rms_px = 0;  ///< result: root mean square of the residuals of the turn's rays, px of the photos
};

/// Error: masks that cannot be compared (an empty one, fewer than six views), or no convergence.
Status fit_jointly(std::vector<SilhouettesToFit>& turns);

}  // namespace rs::capture
