#pragma once
// Photographs as shops show them: each moved and scaled by itself, so that the object fills the frame and is in its
// middle.

#include "capture/calibration/model/picture_place.hpp"
#include "capture/tracer/picture/ray_picture.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

inline constexpr double kRecentredFill = 0.88;  // of the frame's side that the object reaches first

// The place at which what `coverage` (shares 0..1, of the frame's size) shows stands as described; none is changed
// where it shows nothing.
PicturePlace recentred_place(const Image<float>& coverage);

// `rays` at `place`, as if the sensor itself had been moved: nothing is resampled.
RayPicture rays_at(RayPicture rays, const PicturePlace& place);

// `picture` at `place`, bilinear; what lies beyond its border is continued.
Image<RgbaF> picture_at(const Image<RgbaF>& picture, const PicturePlace& place);

}  // namespace rs::capture
