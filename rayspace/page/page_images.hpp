#pragma once
// Images for people to look at: made small, and numbers made colours.

#include "rayspace/image/image.hpp"

#include <string>
#include <vector>

namespace rs {

struct CaptionedImage {
    Image<Rgba8> image;  // straight alpha
    std::string caption;
};

// As large as fits into longest_side_px x longest_side_px (>= 1) with its proportions kept, averaged over areas in
// linear light and weighted by alpha. An image that is small enough already is copied.
Image<Rgba8> scaled_down(ConstImageView<Rgba8> image, int longest_side_px);

// Perceptual colour maps, opaque; `value` is clamped to 0..1, NaN counts as 0.
Rgba8 depth_colour(float value);  // Turbo: blue near 0, green, red near 1
Rgba8 heat_colour(float value);   // black, red, yellow, white; rises evenly in lightness

// low -> 0 .. high -> 1 of depth_colour; transparent where `depth` is not finite. low < high.
Image<Rgba8> depth_image(ConstImageView<float> depth, float low, float high);

// The largest difference of R, G and B (premultiplied by alpha, as image_metrics.hpp compares), as heat: white where
// it is full_scale (1..255) or more; transparent where both images are. Both have the same size.
Image<Rgba8> error_image(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b, int full_scale);

// What reports and `rs-encode evaluate` show as white: a quarter of the range.
inline constexpr int kErrorFullScale = 64;

// `wanted` (or all, where there are fewer) of the numbers 0 .. count - 1, evenly spread, the first among them.
std::vector<int> evenly_spread(int count, int wanted);

}  // namespace rs
