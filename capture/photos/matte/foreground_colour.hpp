#pragma once
// The object's own colour where the photograph shows a mixture with the backdrop, and colours beyond the edge that a
// codec with coarse chroma may mix in without harm.

#include "capture/photos/matte/soft_edge.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

// How far beyond the edge colours are continued under alpha 0: one and a half blocks of a codec with 16x16 macroblocks.
inline constexpr int kBleed_px = 24;

// The cut-out: sRGB with straight alpha. Where alpha is fractional, F = (pixel - (1 - alpha) B) / alpha, which goes
// over into the object's colour near by as alpha nears 0 and the division loses its meaning.
Image<Rgba8> unmix(ConstImageView<Rgba8> photo, const SoftEdge& edge);

// Gives every pixel with alpha 0 the colour of the nearest pixel that is at least half covered, up to kBleed_px away,
// and black farther away. Other pixels keep their values exactly.
void bleed_colours(Image<Rgba8>& picture);

}  // namespace rs::capture
