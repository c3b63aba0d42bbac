#pragma once
// How large photographs are taken: cameras' images have more pixels than an object's images need, and each costs
// time and memory, in the import, in the encoder and wherever the object is shown.

#include "rayspace/base/conventions.hpp"

#include <algorithm>

namespace rs {

// Photographs may be larger than the images that are computed with, where they are made smaller at once: cameras of
// 60 and 100 megapixels are 9,000 and 12,000 pixels wide.
inline constexpr int kMaxPhotographSide_px = 16384;

// Unless another size is asked for: shows an object at the height of a screen.
inline constexpr int kDefaultMaxSide_px = 2048;

// Photographs are made smaller where a side is longer than asked for by more than this factor: not for a little, which
// would only blur them.
inline constexpr double kReducedFrom = 1.25;

// A photograph's pixels for one of the image that is worked with, along a side, for `max_side_px` along the longer
// one; 1 where it stays as it is.
inline double photograph_reduction(int width, int height, int max_side_px) {
    const int longer = std::max(width, height);
    if (longer <= kReducedFrom * max_side_px && longer <= kMaxImageSide_px) return 1;
    return static_cast<double>(longer) / max_side_px;
}

}  // namespace rs
