#pragma once
// The soft edge of an object: how much of every pixel along its border the object covers.
//
// A pixel on the border shows alpha * F + (1 - alpha) * B in linear light. F and B are the object's and the backdrop's
// colours near by, averaged on their own sides of the border with more weight farther away from it, so B holds whatever
// shadow lies there. Where the pixel's colour lies between them is one reading of alpha, in doubt by how both sides'
// colours scatter; the distance to the mask's border is another, with the blur and the looseness that the clear parts
// of the same border have. Both are weighed by their variances.

#include "capture/photos/intake/colour_difference.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

struct SoftEdge {
    Image<float> alpha;         // 0..1
    Image<LinearRgb> object;    // F; means something only where 0 < alpha < 1
    Image<LinearRgb> backdrop;  // B; likewise
};

// `mask` is 255 on the object. `band_px` is how far from the mask's border alpha may be fractional on either side: the
// blur of the pictures' edges, 1..16.
SoftEdge soften_edge(ConstImageView<Rgba8> photo, ConstImageView<std::uint8_t> mask, int band_px);

// The blur to expect of a picture of this size: 2 px up to 900 px, growing with the picture after that.
int expected_band_px(int width, int height);

}  // namespace rs::capture
