#pragma once
// Calibration of a turn from silhouettes alone, for objects without texture: finds the model whose silhouettes are
// consistent with one body (consistency_residuals.hpp).
//
// Silhouettes determine the position and roll of the axis well; the tilt and individual angles (coherence_fit.hpp)
// moderately, unless the object is a body of revolution; the focal length hardly. Undetermined numbers are held near
// the start by a weak prior (silhouette_fit.hpp) and their deviation is infinite. The direction of turning cannot be
// determined: the silhouette from below with the other direction is the same except for perspective. The start's
// direction is kept.

#include "capture/calibration/model/calibration.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <span>

namespace rs::capture {

/// `masks`: coverage 0..255 per view, of the size of start.lens or smaller by a common factor (about 300 px of object
/// are enough). `start`: lens with an assumed f, a pose, one angle per view; in px of the photos. Numbers in `known`
/// replace the start's and are held constant. The first stage estimates the common step of equally spaced views, within
/// about 3 % of the start's; the second estimates individual angles and the distortion, if the silhouettes determine
/// them and they are neither known nor required to be equal. The principal point is not estimated.
///
/// Fails if masks and start do not fit together, if no model near the start makes the silhouettes consistent, or if the
/// start cannot be improved although it does not fit. Runs on the calling tbb arena, deterministic; about 15 s for 36
/// views on 2 cores.
Result<Calibration> calibrate_with_silhouettes(std::span<const Image<std::uint8_t>> masks, const TurntableModel& start,
                                               const KnownInputs& known);

/// True if the silhouettes fit a camera that looks up from below, so that the other direction of turning is likelier.
bool is_seen_from_below(const Calibration& found);

}  // namespace rs::capture
