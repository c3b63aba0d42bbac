#pragma once
/// \file
/// Downscaling by area averaging. Memory besides the result: a few rows.

#include "rayspace/image/image.hpp"

namespace rs::capture {

/// Downscales to a longer side of `max_side_px`; returns a copy of smaller images. Averages sRGB codes, weighted by
/// alpha: for thumbnails and statistics.
Image<Rgba8> reduced(ConstImageView<Rgba8> image, int max_side_px);

/// Downscales by the factor `step` >= 1 in linear light, weighted by alpha, like a sensor of larger pixels. The result
/// of width x height px covers the centre of the image; a remainder of less than one result pixel is cropped
/// symmetrically. width * step and height * step must not exceed the image.
Image<Rgba8> reduced_in_linear_light(ConstImageView<Rgba8> image, int width, int height, double step);

}  // namespace rs::capture
