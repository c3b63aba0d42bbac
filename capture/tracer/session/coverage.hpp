#pragma once
// Recentring of photos as in web shops: each one is shifted and scaled so that the object fills and centres the frame.

#include "capture/calibration/model/calibration.hpp"
#include "capture/tracer/image/ray_image.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

inline constexpr double kRecentredFill = 0.88;  // size of the object over the frame's size, along the limiting axis

/// Placement that recentres the object in `coverage` (0..1, of the frame's size); the identity if it is empty.
ImagePlacement recentring_placement(const Image<float>& coverage);

/// Applies a placement to rays, as if the sensor had moved: without resampling.
RayImage apply_placement(RayImage rays, const ImagePlacement& place);

/// Resamples an image bilinearly at a placement; the border is extended.
Image<RgbaF> apply_placement(const Image<RgbaF>& image, const ImagePlacement& place);

}  // namespace rs::capture
