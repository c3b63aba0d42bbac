#pragma once
/// \file
/// Alpha along the contour of a binary mask: the share of every pixel that the object covers.
///
/// A pixel on the contour shows alpha * F + (1 - alpha) * B in linear light. F and B are local weighted means of the
/// object's and the background's colours (edge_statistics.hpp), so that B includes shadows. Two estimates of alpha are
/// fused by their variances: the projection of the pixel's colour between B and F by Fisher's linear discriminant, and
/// the edge profile, alpha as a function of the distance from the contour, which is learnt from the clear pixels of the
/// same photo and represents its blur and the mask's accuracy. The second pass repeats this with the mask alpha >= 0.5.
///
/// All functions are pure and thread-safe.

#include "capture/photos/foreground/foreground_parameters.hpp"
#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

/// In the photo's size.
struct AlphaEstimate {
    Image<float> alpha;           ///< 0..1
    Image<LinearRgb> foreground;  ///< F; defined where 0 < alpha < 1
    Image<LinearRgb> background;  ///< B; likewise
};

/// \param mask 255 on the object, 0 elsewhere; of the photo's size
/// \param band_px alpha may be fractional up to this distance from the contour on either side: the blur of edges, 1..16
AlphaEstimate estimate_alpha(ConstImageView<Rgba8> photo, ConstImageView<std::uint8_t> mask, int band_px,
                             const ForegroundParameters::Alpha& parameters = {});

/// Expected blur of edges in a photo of this size, px: 2 up to 1124 px, then in proportion to the longer side, at most
/// 8 (defaults).
int expected_edge_width_px(int width, int height, const ForegroundParameters::Alpha& parameters = {});

}  // namespace rs::capture
