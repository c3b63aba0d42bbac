#pragma once
// How much brighter one picture of a turn is than another: lamps warm up, and cameras choose their exposure anew.

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

// Per channel the factor from `plate` to `photo`, in linear light: the median over the pixels where `still` is not 0,
// which should be those that nothing ever covers. Clipped and almost black pixels are left aside, and where less than a
// third is left the factor is 1; it is kept within 0.5..2. All three have one size.
LinearRgb exposure_gain(ConstImageView<Rgba8> photo, ConstImageView<LinearRgb> plate,
                        ConstImageView<std::uint8_t> still);

}  // namespace rs::capture
