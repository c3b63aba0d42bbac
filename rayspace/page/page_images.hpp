#pragma once
// Images for display in reports: reduction, and colour maps for numbers.

#include "rayspace/image/image.hpp"

#include <string>
#include <vector>

namespace rs {

struct CaptionedImage {
    Image<Rgba8> image;  // straight alpha
    std::string caption;
};

/// Reduces an image to fit into longest_side_px x longest_side_px (>= 1) with its proportions kept, by area averages in
/// linear light weighted by alpha. Smaller images are copied.
Image<Rgba8> downscale(ConstImageView<Rgba8> image, int longest_side_px);

/// Perceptual colour maps, opaque; `value` is clamped to 0..1, NaN counts as 0.
Rgba8 depth_colour(float value);  // Turbo: blue near 0, green, red near 1
Rgba8 heat_colour(float value);   // black, red, yellow, white; rises evenly in lightness

/// Maps low..high to 0..1 of depth_colour; transparent where `depth` is not finite. low < high.
Image<Rgba8> depth_image(ConstImageView<float> depth, float low, float high);

/// Heat map of the largest difference of R, G and B (premultiplied by alpha, as in image_metrics.hpp): white at
/// full_scale (1..255) or more; transparent where both images are. Both have the same size.
Image<Rgba8> error_image(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b, int full_scale);

/// The error that reports and `rs-encode evaluate` show as white: a quarter of the range.
inline constexpr int kErrorFullScale = 64;

/// `wanted` evenly spaced numbers of 0 .. count - 1 (all if there are fewer), including 0.
std::vector<int> select_evenly(int count, int wanted);

}  // namespace rs
