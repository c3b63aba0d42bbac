#pragma once
/// \file
/// Background of a turn by temporal consensus, and inpainting of what it does not show.
///
/// The camera is fixed, so the background has the same colour in all frames in which the object does not cover it.
/// temporal_consensus() follows the exposure correction; inpainting follows the clean plate (clean_plate.hpp).

#include "capture/photos/background/background_parameters.hpp"
#include "capture/photos/background/exposure_normalized_frames.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

/// Most frequent colour of every pixel, whether it is the background's or the object's.
struct BackgroundEstimate {
    Image<Rgba8> colour;     ///< mean of the largest group of agreeing frames, sRGB, opaque
    Image<float> agreement;  ///< the group's share of all frames, 0..1
};

/// A group is the frames within Estimate::tolerance_codes of one of them, by denoised values; of equally large groups
/// the first frame's. Cost: quadratic in the number of frames where a pixel changes.
BackgroundEstimate temporal_consensus(const ExposureNormalizedFrames& frames,
                                      const BackgroundParameters::Estimate& parameters);

/// Inpaints the gaps between known pixels of a row by linear interpolation in linear light where both ends show the
/// same surface, and sets `known` (of the image's size, not 0 = known) to 255 there. Most edges of a background with a
/// table or a wall are horizontal, so the same row shows what the object covers.
void inpaint_rows(Image<Rgba8>& image, Image<std::uint8_t>& known,
                  const BackgroundParameters::RowInpainting& parameters);

/// Fills the pixels where `known` is 0 smoothly from the others, in linear light (pull-push interpolation, Gortler et
/// al., "The Lumigraph", 1996). Leaves the image unchanged where nothing is known.
void fill_push_pull(Image<Rgba8>& image, const Image<std::uint8_t>& known);

}  // namespace rs::capture
