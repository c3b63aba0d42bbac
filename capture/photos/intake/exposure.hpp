#pragma once
/// \file
/// Exposure gain between photos of a turn: lamps warm up, and cameras adjust their exposure.

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

/// Gain per channel from `plate` to `photo` in linear light: the median ratio over a grid of the pixels where `still`
/// is not 0, which should be pixels that nothing ever covers. Clipped and nearly black pixels are excluded. 1 where
/// less than 30 % of the sampled pixels remain; clamped to 0.5..2. All three images have one size. Thread-safe.
LinearRgb exposure_gain(ConstImageView<Rgba8> photo, ConstImageView<LinearRgb> plate,
                        ConstImageView<std::uint8_t> still);

}  // namespace rs::capture
