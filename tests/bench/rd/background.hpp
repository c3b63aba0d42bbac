#pragma once
// What codecs without alpha are shown where the object is not. It is theirs to choose: nobody compares those pixels,
// but they cost bits, and a hard edge to them costs more.

#include "rayspace/image/image.hpp"

namespace rs::bench {

enum class Background {
    kBlack,
    kSpread,  // the object's colours spread outwards, ever smoother (pull-push over a pyramid of halved images)
};

// Pixels of alpha 0 get the background's colour; alpha stays, and so do all other pixels.
Image<Rgba8> with_background(ConstImageView<Rgba8> image, Background background);

// The same image, opaque.
Image<Rgba8> made_opaque(Image<Rgba8> image);

}  // namespace rs::bench
