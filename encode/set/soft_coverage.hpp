#pragma once
// Detects regions of soft coverage: shadows on a turntable that were segmented together with the object, glass, gauze.
// These need more than a few alpha levels, unlike the edges of an alpha matte, which are only as soft as the lens.

#include "rayspace/image/image.hpp"

#include <cstdint>

namespace rs::encode {

/// The least alpha that counts as visible.
inline constexpr int kMinVisibleAlpha = 8;

/// Morphological opening: 255 where a sample belongs to a square of 2 radius + 1 samples inside the image that all have
/// alpha from kMinVisibleAlpha to 255 - kMinVisibleAlpha, else 0.
Image<std::uint8_t> find_soft_patches(ConstImageView<std::uint8_t> alpha, int radius);

/// Dilation: 255 where a sample at most `radius` away in x and y is not 0, else 0.
Image<std::uint8_t> dilated(const Image<std::uint8_t>& set, int radius);

}  // namespace rs::encode
