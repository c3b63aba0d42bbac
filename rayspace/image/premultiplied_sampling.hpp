#pragma once
// One sample of an sRGB picture with straight alpha at any position, filtered where averages mean something: in linear
// light, weighted by alpha. The kernel is Catmull-Rom, which keeps a picture as it is at whole pixel steps and is meant
// for scales near 1: it does not prefilter.

#include "rayspace/image/image.hpp"

namespace rs {

// The colour at continuous pixel position (x, y), pixel centres at +0.5; transparent outside of the picture, and all
// zeros where nothing is covered. Any finite position within +-2^30. Thread-safe.
Rgba8 sample_premultiplied(ConstImageView<Rgba8> picture, double x, double y);

}  // namespace rs
