#pragma once
// Does the last picture of a turn repeat the first? Many turntables stop where they began and take that view twice.

#include "rayspace/image/image.hpp"

#include <span>

namespace rs::capture {

// Mean absolute difference of two pictures of one size, 0..255: RGB on black, alpha as a fourth channel.
double mean_difference(ConstImageView<Rgba8> a, ConstImageView<Rgba8> b);

struct RepeatTest {
    double first_to_last = 0;  // mean_difference of the first and the last picture
    double neighbours = 0;     // the smaller one of first to second and last but one to last
    bool last_repeats_first = false;
};

// `turn` holds the pictures in order, all of one size, made small beforehand (noise averages out). The last one is a
// repeat where it differs from the first by less than 0.4 of what the two pairs of neighbours beside the seam differ
// by: a real next step differs as much as they do, and a second shot of the same pose by noise only. What hardly
// changes over the turn (a plain vase) gives ratios near 1 and is never called a repeat. Needs 4 pictures; fewer: no
// repeat.
RepeatTest test_repeat(std::span<const Image<Rgba8>> turn);

}  // namespace rs::capture
