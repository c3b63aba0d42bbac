#pragma once
// Pictures made smaller by averaging. Besides the result it takes the memory of a few rows.

#include "rayspace/image/image.hpp"

namespace rs::capture {

// No side is longer than `side_px`; a copy where the picture is small enough. sRGB codes are averaged, with alpha as
// their weight: for looking at.
Image<Rgba8> reduced(ConstImageView<Rgba8> picture, int side_px);

// width x height pixels that show step x step of the picture's each, from its middle: what is left over at its sides,
// less than a pixel of the result, is cut off alike. Light is averaged, as a sensor of larger pixels would, with alpha
// as its weight; alpha itself as it is. step >= 1, and the result must fit into the picture.
Image<Rgba8> averaged_light(ConstImageView<Rgba8> picture, int width, int height, double step);

}  // namespace rs::capture
