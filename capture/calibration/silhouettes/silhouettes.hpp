#pragma once
// Calibration of a turn from outlines alone, for objects without texture: the model under which all outlines can be
// those of one body (consistency_residuals.hpp).
//
// What outlines show: where the axis is and how it leans in the image, well; how far the camera looks down and single
// angles (silhouette_angles.hpp), fairly, unless the object is a body of revolution; the focal length, hardly. What
// they cannot show is held near the start by a weak prior (silhouette_fit.hpp) and its deviation is infinite. The sense
// of turning cannot be known: an outline taken from below with the other sense is the same but for perspective. The
// start's sense is kept.

#include "capture/calibration/model/calibration.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <span>

namespace rs::capture {

// `masks`: coverage 0..255 per view, of the size of start.lens or smaller by a common factor (about 300 px of object
// are enough). `start`: lens with an assumed f, a pose, one angle per view; in px of the photographs. What `known`
// holds is taken instead and not estimated. First the common step of equally spaced views is, around start's to within
// some 3 %, then single angles and the distortion with them, where the outlines show them and they are neither known
// nor held equal. The principal point never is.
//
// Fails where masks and start do not fit together, where the outlines of no model near the start agree, and where the
// start cannot be improved although it does not fit. Works on the threads of the calling tbb arena, deterministic;
// about 15 s for 36 views on 2 cores.
Result<Calibration> calibrate_with_silhouettes(std::span<const Image<std::uint8_t>> masks, const TurntableModel& start,
                                               const KnownInputs& known);

// The outlines fit a camera that looks up from below, so the other sense of turning is likelier.
bool seems_to_look_up(const Calibration& found);

}  // namespace rs::capture
