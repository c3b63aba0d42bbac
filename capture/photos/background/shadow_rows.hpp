#pragma once
/// \file
/// Rows of the image in which the object casts no shadow on a background with a gradient model.
///
/// Shadows fall on the surface below the object. Above it, a dark region is more likely a grey side of the
/// object; foreground_score() uses that. Follows fit_background_gradient().

#include "capture/photos/background/background_parameters.hpp"
#include "capture/photos/background/exposure_normalized_frames.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

/// Mask of the frames' size: 255 in all rows above the highest one in which enough frames show a soft shadow, less a
/// margin. A soft shadow is darker than the plate and reachable from the image border without crossing an edge of the
/// log ratio (log_ratio.hpp). `plate`: the gradient, in the frames' size. Empty if there is no such row. Shadows in few
/// frames and those with sharp edges only are not detected.
Image<std::uint8_t> shadow_free_rows(const ExposureNormalizedFrames& frames, ConstImageView<Rgba8> plate,
                                     const BackgroundParameters::Shadow& parameters);

}  // namespace rs::capture
