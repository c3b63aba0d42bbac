#pragma once
/// \file
/// Rectification: resamples the photos of a calibrated turn to the images of an upright camera at the same position,
/// without lens distortion, tilt, pan or roll. Each image column is then a vertical plane of rays, and the encoder does
/// not have to resample again.
///
/// The camera is fixed, so one frame and one mapping apply to all views. The upright camera is at (0, 0, 1) in the
/// table frame of turntable_model.hpp and looks along -Z, straight at the axis: its pose is zero, its lens a pinhole,
/// and the axis is in the column cx. Its horizon, cy, may be outside the frame.

#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/model/turntable_model.hpp"
#include "capture/photos/segmentation/turn_silhouette.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image/image.hpp"

#include <optional>
#include <span>

namespace rs::capture {

/// Image frame of the upright camera.
struct UprightFrame {
    Lens lens;         ///< width, height, f_px, cx, cy; no distortion
    double scale = 1;  ///< px per px of the photo at the object's middle, along the direction of the lower scale
};

/// Margin around the object: for curved edges beyond the corners of the boxes, and for the support of filters.
inline constexpr int kUprightMargin_px = 8;

/// Chooses the frame that contains the boxes. `object_boxes` bound the object's pixels, each in one or several views,
/// in px of the photos (model.lens); empty boxes are ignored. The focal length is the smallest at which no pixel of a
/// box loses detail, limited to an enlargement of 1.5 in any direction at the object's middle, and at least the one
/// that keeps the scale there. It is lowered, down to half the scale, only if the frame would exceed
/// kMaxImageSide_px. Errors: no box; a camera that looks down so steeply that an upright one cannot see a box within
/// these limits; distortion that cannot be inverted within a box.
Result<UprightFrame> plan_upright_frame(const TurntableModel& model, std::span<const TurnSilhouette::Box> object_boxes);

/// Rectifies a photo's foreground image (sRGB, straight alpha, of the size of model.lens). Samples it once by
/// sample_premultiplied(); the result is transparent outside the photo. bleed_colours() then extends the object's
/// colours under alpha 0. `place` is the displacement of the photo from the image of the model's fixed camera. About
/// 0.2 s per megapixel of the frame. Thread-safe.
Image<Rgba8> rectified(const TurntableModel& model, const UprightFrame& frame, ConstImageView<Rgba8> cut_out,
                       const ImagePlacement& place = {});

/// Makes the rig of the rectified images: one upright camera per view of the model, without file names. The unit of
/// length is the object radius: object_radius is 1, the radius of the circle about the axis that contains all of
/// `visible` and to which its outermost column is tangent. Y = 0 where the middle row of `visible` meets the axis.
/// `visible` is in px of the rectified images (their TurnSilhouette::visible()), not empty, and extends to at least one
/// side of the axis. `ground_height` is the height of the surface below the object, if known, in the table frame
/// (turntable_model.hpp); it becomes the rig's foot_height.
Rig make_rig(const TurntableModel& model, const UprightFrame& frame, const TurnSilhouette::Box& visible,
             std::optional<double> ground_height = std::nullopt);

}  // namespace rs::capture
