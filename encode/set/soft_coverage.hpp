#pragma once
// Coverage that is soft over an area: shadows on a turntable that were cut out along with the object, glass, gauze. It
// is something to be shown, and in more than a few steps of alpha; the rim of a cut-out is only as soft as the lens
// was.

#include "rayspace/image/image.hpp"

#include <cstdint>

namespace rs::encode {

// The least alpha that counts as something.
inline constexpr int kFaintest = 8;

// 255 where a sample belongs to a patch of 2 radius + 1 by 2 radius + 1 samples which all have alpha from kFaintest to
// 255 - kFaintest, else 0. Patches lie within the image.
Image<std::uint8_t> soft_patches(ConstImageView<std::uint8_t> alpha, int radius);

// 255 where a sample at most `radius` away along x and along y is not 0, else 0.
Image<std::uint8_t> dilated(const Image<std::uint8_t>& set, int radius);

}  // namespace rs::encode
