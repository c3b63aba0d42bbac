#pragma once
// Quantised coefficients of one transform.

#include "rayspace/codec/kernels/transform.hpp"

#include <cstdint>

namespace rs::codec {

/// Levels of one block, with a margin of two zero rows and columns so that neighbours need no bounds checks.
struct Levels {
    static constexpr int kStride = kLargestTransform + 2;
    std::int16_t at[(kLargestTransform + 2) * kStride] = {};
    int used = 0;  // all non-zero levels are in the first `used` rows and columns
};

}  // namespace rs::codec
