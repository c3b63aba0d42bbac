#pragma once
/// \file
/// From a segmentation to the image of the object alone: sRGB with straight alpha.
///
/// Segmenter -> make_foreground_image(): estimate_alpha() -> unmix() -> shadow layer -> bleed_colours().

#include "capture/photos/foreground/alpha_estimation.hpp"
#include "capture/photos/foreground/foreground_parameters.hpp"
#include "capture/photos/segmentation/segmenter.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

/// Distance in px up to which colours are continued beyond the edge under alpha 0: one and a half macroblocks of a
/// codec with 16x16 px, so that its subsampled chroma mixes in no other colour.
inline constexpr int kBleed_px = 24;

/// Foreground colour where the photo shows a mixture with the background: F = (pixel - (1 - alpha) B) / alpha in linear
/// light. As alpha approaches 0, where the division is ill-conditioned, F fades to the object's colour nearby.
Image<Rgba8> unmix(ConstImageView<Rgba8> photo, const AlphaEstimate& edge);

/// Gives every pixel of alpha 0 the colour of the nearest pixel of alpha >= 128, up to kBleed_px away, and black
/// beyond. Other pixels keep their values.
void bleed_colours(Image<Rgba8>& image);

/// The foreground image of one photo, in its size. A final alpha is taken over as it is; a binary mask gets a soft
/// edge. The shadow layer of `segmentation` is composited below the object. Of `parameters` only `alpha` is used.
/// Thread-safe.
Image<Rgba8> make_foreground_image(ConstImageView<Rgba8> photo, const Segmentation& segmentation,
                                   const ForegroundParameters& parameters = {});

}  // namespace rs::capture
