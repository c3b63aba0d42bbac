#pragma once
// Background of images for codecs without alpha. Its pixels are not compared, but they cost bits, and a hard edge costs
// more; anchors therefore use the background that suits them best.

#include "rayspace/image/image.hpp"

namespace rs::bench {

enum class Background {
    kBlack,
    kSpread,  // object colours extended outwards with increasing smoothness (pull-push pyramid)
};

/// Fills the colours of pixels with alpha 0; alpha and other pixels are unchanged.
Image<Rgba8> with_background(ConstImageView<Rgba8> image, Background background);

/// Sets alpha to 255.
Image<Rgba8> made_opaque(Image<Rgba8> image);

}  // namespace rs::bench
