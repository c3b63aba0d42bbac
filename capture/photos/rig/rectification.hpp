#pragma once
// From photographs of a calibrated turn to what an upright camera at the same place would have taken: no lens
// distortion, no tilt, pan or roll, so that every picture column is a vertical plane of rays and the encoder need not
// resample again.
//
// The camera stands still, so one frame and one mapping serve all views. The upright camera stands in the table frame
// of turntable_model.hpp at (0, 0, 1) and looks along -Z, straight at the axis: its pose is zero, its lens a pinhole,
// and the axis appears in the column cx. Its horizon, cy, may lie outside of the frame.

#include "capture/calibration/model/picture_place.hpp"
#include "capture/calibration/model/turntable_model.hpp"
#include "capture/photos/segmentation/turn_silhouette.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/rig.hpp"
#include "rayspace/image/image.hpp"

#include <optional>
#include <span>

namespace rs::capture {

struct UprightFrame {
    Lens lens;         // width, height, f_px, cx, cy; no distortion
    double scale = 1;  // px per px of the photograph at the object's middle, along the direction in which it is lower
};

// Room around the object, px: for what the boxes' corners do not show of curved edges, and for filters.
inline constexpr int kUprightMargin_px = 8;

// `object_boxes` hold the object's pixels of one or several views each, in px of the photographs (model.lens); empty
// ones do not count. The focal length is the least at which no pixel of a box loses detail, as long as no direction at
// the object's middle is enlarged more than 1.5 times, and never lower than what keeps the scale there. Only where the
// frame would be larger than kMaxPictureSide_px it is lowered, down to half the scale. Errors: no box, the camera looks
// so steeply down that an upright one cannot see a box within that, the distortion cannot be undone within a box.
Result<UprightFrame> plan_upright_frame(const TurntableModel& model, std::span<const TurnSilhouette::Box> object_boxes);

// A photograph's cut-out (sRGB, straight alpha, of model.lens' size) as the upright camera sees it: sampled once by
// sample_premultiplied(), transparent where the photograph does not reach; then the object's colours are continued
// under alpha 0 by bleed_colours(). `place` states how the photograph was moved from
// where the still camera of the model took it. About 0.2 s per megapixel of the frame. Thread-safe.
Image<Rgba8> rectified(const TurntableModel& model, const UprightFrame& frame, ConstImageView<Rgba8> cut_out,
                       const PicturePlace& place = {});

// One camera per view of the model, without file names, all upright, in object radii: object_radius is 1, the radius
// about the axis that holds everything within `visible`, whose outermost column is tangent to it; Y = 0 where the
// middle row of `visible` meets the axis. `visible` is in px of the rectified pictures (TurnSilhouette::visible() of
// them), not empty, and reaches to one side of the axis at least. `ground_height` is where the object stands, if known,
// in the table frame (turntable_model.hpp); it becomes the rig's foot_height.
Rig make_rig(const TurntableModel& model, const UprightFrame& frame, const TurnSilhouette::Box& visible,
             std::optional<double> ground_height = std::nullopt);

}  // namespace rs::capture
