#pragma once
// Inverse transform of coded images: the separable integer DCTs of 8x8 and 16x16 of HEVC (ITU-T H.265, 8.6.4.2), which
// are exact in 16-bit intermediates and cheap in hardware. encode/FORMAT.md, section "Transform".

#include <cstdint>

namespace rs::codec {

inline constexpr int kLargestTransform = 16;

/// Rows of the 16-point matrix. The 8-point matrix consists of the first 8 columns of every second row.
extern const std::int8_t kTransform16[16][16];

/// Computes residual[y * size + x] from coefficients[v * size + u] (int16 range), size 8 or 16. Coefficients outside of
/// the first `used` rows and columns must be zero (used: 1 .. size). The results fit in 16 bits.
void inverse_transform(const std::int16_t* coefficients, int size, int used, std::int16_t* residual);

/// Quantiser step in sixteenths of an orthonormal coefficient's unit: mantissa {16, 17, 19, 21, 23, 25, 27, 29} of
/// index % 8, doubled for every 8. index: 0 .. kMaxStep.
inline constexpr int kMaxStep = 63;
constexpr int step_q4(int index) {
    constexpr int kMantissas[8] = {16, 17, 19, 21, 23, 25, 27, 29};
    return kMantissas[index & 7] << (index >> 3);
}

/// Quantised coefficients ("levels") of one transform, with a margin of two zero rows and columns so that neighbours
/// need no bounds checks.
struct Levels {
    static constexpr int kStride = kLargestTransform + 2;
    std::int16_t at[(kLargestTransform + 2) * kStride] = {};
    int used = 0;  // all non-zero levels are in the first `used` rows and columns
};

/// The coefficient of a level (|level| <= 32767) at a quantiser step, in the scale of inverse_transform: orthonormal
/// coefficients times 16 (size 8) or 8 (size 16).
std::int16_t dequantise(int level, int step, int size);

}  // namespace rs::codec
