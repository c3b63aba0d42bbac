#pragma once
// Sizes of input photos. Cameras have more pixels than an object needs, and each costs time and memory in the import,
// the encoder and the viewers.

#include "rayspace/base/conventions.hpp"

#include <algorithm>

namespace rs {

/// Photos may be larger than the images used in computations, if they are reduced at once: cameras of 60 and 100
/// megapixels are 9,000 and 12,000 pixels wide.
inline constexpr int kMaxPhotoSide_px = 16384;

/// Default size, which shows an object at the height of a screen.
inline constexpr int kDefaultMaxSide_px = 2048;

/// Photos are reduced only if a side is longer than requested by more than this factor, since a slight reduction only
/// blurs.
inline constexpr double kMinReduction = 1.25;

/// The reduction factor along a side: photo pixels per pixel of the working image, whose longer side is `max_side_px`;
/// 1 if the photo is not reduced.
inline double photo_reduction(int width, int height, int max_side_px) {
    const int longer = std::max(width, height);
    if (longer <= kMinReduction * max_side_px && longer <= kMaxImageSide_px) return 1;
    return static_cast<double>(longer) / max_side_px;
}

}  // namespace rs
