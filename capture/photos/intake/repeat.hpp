#pragma once
/// \file
/// Detects that the last photo of a turn repeats the first: many turntables stop at their first angle and capture it
/// twice.

#include "rayspace/image/image.hpp"

#include <span>

namespace rs::capture {

/// Mean absolute difference of two images of one size, sRGB codes 0..255: RGB composited on black, alpha as a fourth
/// channel.
double mean_difference(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b);

struct RepeatDetection {
    double first_to_last = 0;  ///< mean_difference() of the first and the last image
    double neighbours = 0;     ///< smaller mean_difference() of the first two and of the last two images
    bool last_repeats_first = false;
};

/// The last image repeats the first if their difference is less than 0.4 times the smaller difference of the neighbours
/// at the seam: a further step differs as much as the neighbours, a second shot of one pose only by noise. An object
/// that hardly changes, such as a plain vase, has ratios near 1 and is not reported. \param turn images in order, of
/// one size, downscaled to suppress noise; fewer than 4 are never a repeat
RepeatDetection detect_repeat(std::span<const Image<Rgba8>> turn);

}  // namespace rs::capture
