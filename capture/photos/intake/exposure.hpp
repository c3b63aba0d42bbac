#pragma once
/// \file
/// Exposure gain between photos of a turn: lamps warm up, and cameras adjust their exposure.

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

#include <array>
#include <cstdint>

namespace rs::capture {

/// Gain per channel from `plate` to `photo` in linear light: the median ratio over a grid of the pixels where `still`
/// is not 0, which should be pixels that nothing ever covers. Clipped and nearly black pixels are excluded. 1 where
/// less than 30 % of the sampled pixels remain; clamped to 0.5..2. All three images have one size. Thread-safe.
LinearRgb exposure_gain(ConstImageView<Rgba8> photo, ConstImageView<LinearRgb> plate,
                        ConstImageView<std::uint8_t> still);

/// Table of sRGB codes of linear light divided by `gain`. 255 stays 255: where a photo is clipped, the true value is
/// unknown.
std::array<std::uint8_t, 256> exposure_division_table(float gain);

}  // namespace rs::capture
