#pragma once
// Section 9 of engine/RECONSTRUCTION.md: mixes the images of a view by two rings. Integer, normative.

#include "rayspace/image/image.hpp"

#include <cstdint>

namespace rs::engine {

/// Pixel of a view between two rings: `weight_q8` (0..256) is that of the second ring.
Rgba8 mix_pixels(const Rgba8& nearest, const Rgba8& second, int weight_q8);

/// Replaces the image and depths of the nearest ring by the mixed ones. All images have one size; `depth_q20` and
/// `second_depth_q20` may both be empty.
void mix_rings(ImageView<Rgba8> nearest, ImageView<std::int32_t> depth_q20, ConstImageView<Rgba8> second,
               ConstImageView<std::int32_t> second_depth_q20, int weight_q8);

}  // namespace rs::engine
