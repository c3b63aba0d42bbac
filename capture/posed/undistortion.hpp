#pragma once
/// \file
/// Lens distortion is removed from the foreground images of posed photos: each is resampled once, in linear light and
/// weighted by alpha, for a pinhole camera with the same focal lengths and pose.

#include "capture/photos/segmentation/turn_silhouette.hpp"
#include "capture/posed/cameras/posed_camera.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <opencv2/core.hpp>

namespace rs::capture {

/// The pinhole camera of an undistorted photo. It has the photo's frame, extended by whole pixels to contain `visible`,
/// the box of the object's pixels, after undistortion; the principal point is shifted with the frame. Without
/// distortion it is the camera of the photo, unchanged. Errors: distortion that cannot be inverted at the object (it
/// folds the image, or the ray is more than 80 degrees off the axis); a frame of more than kMaxImageSide_px.
Result<Camera> undistorted_camera(const PosedCamera& photo, const TurnSilhouette::Box& visible,
                                  const std::string& name);

/// Resamples a foreground image (sRGB, straight alpha, the size of photo.camera) for `target`, a result of
/// undistorted_camera(). Transparent outside of the photo. Colours are extended under alpha 0 by bleed_colours().
/// Without distortion `foreground` itself. Thread-safe.
Image<Rgba8> undistorted(const PosedCamera& photo, const Camera& target, Image<Rgba8> foreground);

/// The opposite: resamples a mask of the pinhole camera `target`, and of its size, for the photo. 0
/// outside of the mask's frame. Thread-safe.
cv::Mat1b distorted_mask(const PosedCamera& photo, const Camera& target, const cv::Mat1b& mask);

}  // namespace rs::capture
