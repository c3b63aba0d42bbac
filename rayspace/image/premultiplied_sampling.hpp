#pragma once
// One sample of an sRGB image with straight alpha at any position, filtered where averages mean something: in linear
// light, weighted by alpha. The kernel is Catmull-Rom, which keeps an image as it is at whole pixel steps and is meant
// for scales near 1: it does not prefilter.

#include "rayspace/image/image.hpp"

#include <vector>

namespace rs {

// The colour at continuous pixel position (x, y), pixel centres at +0.5; transparent outside of the image, and all
// zeros where nothing is covered. Any finite position within +-2^30. Thread-safe.
Rgba8 sample_premultiplied(ConstImageView<Rgba8> image, double x, double y);

// An image made ready to be sampled at most of its pixels: the same values to the bit, in a quarter of the time. Takes
// 16 bytes per pixel of the box around what is covered.
class PremultipliedImage {
public:
    explicit PremultipliedImage(ConstImageView<Rgba8> image);
    // As sample_premultiplied(). Thread-safe.
    [[nodiscard]] Rgba8 sample(double x, double y) const;

private:
    int left_ = 0, top_ = 0;  // of pixels_ in the image
    Image<RgbaF> pixels_;     // linear light times alpha, and alpha
    // From the first that is covered to behind the last; begin == end where none is.
    struct Columns {
        int begin = 0, end = 0;
    };
    std::vector<Columns> covered_;  // [row of pixels_]
};

}  // namespace rs
