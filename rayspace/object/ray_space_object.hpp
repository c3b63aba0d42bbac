#pragma once
// A ray-space object in memory (rayspace/api/types/ray_space_object.hpp) with its coded images, and the order in which
// images are stored.

#include "rayspace/api/types/ray_space_object.hpp"
#include "rayspace/codec/code/coded_images.hpp"
#include "rayspace/image/image.hpp"

namespace rs {

/// The size of chroma planes: half, rounded up.
constexpr int half_size(int size) {
    return (size + 1) / 2;
}

/// Progressive level of a ring's n-th view, counted from 0. Views are stored and loaded by level: every 8th view of a
/// ring first (level 0), then every 4th (1), every 2nd (2) and all (3).
constexpr int progressive_level(int n) {
    if (n % 8 == 0) return 0;
    if (n % 4 == 0) return 1;
    return n % 2 == 0 ? 2 : 3;
}
inline constexpr int kProgressiveLevels = 4;

}  // namespace rs
