#pragma once
// Photographs as shops show them: each moved and scaled by itself, so that the object fills the frame and is in its
// middle.

#include "capture/calibration/model/image_placement.hpp"
#include "capture/tracer/image/ray_image.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

inline constexpr double kRecentredFill = 0.88;  // of the frame's side that the object reaches first

// The place at which what `coverage` (shares 0..1, of the frame's size) shows stands as described; none is changed
// where it shows nothing.
ImagePlace recentred_place(const Image<float>& coverage);

// `rays` at `place`, as if the sensor itself had been moved: nothing is resampled.
RayImage rays_at(RayImage rays, const ImagePlace& place);

// `image` at `place`, bilinear; what lies beyond its border is continued.
Image<RgbaF> image_at(const Image<RgbaF>& image, const ImagePlace& place);

}  // namespace rs::capture
