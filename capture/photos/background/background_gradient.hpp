#pragma once
/// \file
/// Background gradient model: a smooth backdrop of one colour, extrapolated behind the object, and its rows without
/// shadow.
///
/// In a studio the background is paper, a wall or a table whose light varies smoothly, with or without a horizon. The
/// model is fitted to a band along the image border and replaces the clean plate, which has two faults there: it grows
/// into the sides of a white object, which are as bright and smooth as the background, and it contains the core of a
/// shadow, which is static over most of the turn. Follows the clean plate in estimate_background().

#include "capture/photos/background/background_parameters.hpp"
#include "capture/photos/background/exposure_normalized_frames.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>

namespace rs::capture {

/// Linear light of the background in the plate's size. Per row a level, times a polynomial along the row whose
/// coefficients vary with the row; iterated least squares of the log codes over the border band where `always_visible`
/// (of the plate's size) is not 0. Isolated deviations, such as a mark on the wall or a cable, are copied from the
/// plate. Empty where the model does not apply: a side of the band is hardly visible, most of the band does not fit,
/// there are many deviations, or one is connected to the region that the object sweeps and may continue behind the
/// object (a table, a turntable, a seam).
Image<LinearRgb> fit_background_gradient(ConstImageView<Rgba8> plate, ConstImageView<std::uint8_t> always_visible,
                                         const BackgroundParameters& parameters);

/// Rows of the image in which the object casts no shadow on a background with a gradient model. Shadows fall on the
/// surface below the object. Above it, a dark region is more likely a grey side of the object; foreground_score() uses
/// that. Follows fit_background_gradient().
///
/// Mask of the frames' size: 255 in all rows above the highest one in which enough frames show a soft shadow, less a
/// margin. A soft shadow is darker than the plate and reachable from the image border without crossing an edge of the
/// log ratio (log_ratio.hpp). `plate`: the gradient, in the frames' size. Empty if there is no such row. Shadows in few
/// frames and those with sharp edges only are not detected.
Image<std::uint8_t> shadow_free_rows(const ExposureNormalizedFrames& frames, ConstImageView<Rgba8> plate,
                                     const BackgroundParameters::Shadow& parameters);

}  // namespace rs::capture
