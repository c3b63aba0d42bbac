#pragma once
/// \file
/// Foreground mask by enclosing edges, for white and grey objects before the light gradient of a studio.
///
/// The sides of such objects have the colour of a shadow on the background, and the contrast at their contour vanishes
/// in places, so that neither colour nor graph cut separate them. But a soft shadow fades into the background, while an
/// object has an edge all around: a flood fill from the image border that stops at edges reaches the shadow and no part
/// of the object. What it reaches becomes certain background, what edges enclose certain foreground, and
/// segment_foreground() labels the rest.

#include "capture/photos/foreground/foreground_mask.hpp"
#include "capture/photos/foreground/foreground_parameters.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

/// \param plate of the photo's size; must be right behind the object, too, as a fitted gradient is
///   (background_gradient.hpp). Its `visible` and `occluded` are ignored.
/// \return 255 = object. Empty where the enclosed area is small relative to the object, because a shadow within a loop
///   is enclosed, too, and where noise causes edges everywhere. Thread-safe.
Image<std::uint8_t> segment_by_edges(const LabPhoto& photo, const CleanPlateView& plate,
                                     const ForegroundParameters& parameters);

}  // namespace rs::capture
