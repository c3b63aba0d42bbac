#pragma once
// Inner loops of the encoder's search: sums over samples, compiled for each SIMD target of Highway and dispatched at
// run time. All targets give the same integers. No function allocates; all are thread-safe.

#include <cstddef>
#include <cstdint>

namespace rs::encode {

/// Forward transform, the inverse of codec::inverse_transform: residual[y * size + x] -> coefficients[v * size + u],
/// orthonormal coefficients times 16 (size 8) or 8 (size 16).
void forward_transform(const std::int16_t* residual, int size, std::int32_t* coefficients);

/// A square block of samples to compare with: `size` (8 or 16) rows of `size`. The mask is 255 where a sample is valid,
/// else 0.
struct SampleBlock {
    const std::uint8_t* wanted = nullptr;
    const std::uint8_t* mask = nullptr;
    std::ptrdiff_t stride = 0;  // of samples and mask
    int size = 16;
};

/// Sum of absolute differences over the valid samples.
int absolute_differences(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride);

/// Sum of absolute differences from the mean of two predictions; `other` has rows of the target's size.
int absolute_differences_of_mean(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride,
                                 const std::uint8_t* other);

/// Sum of squared differences over the valid samples.
int squared_differences(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride);

/// Sum of the magnitudes of the orthonormal 8x8 Hadamard transforms of the differences, which are 0 at invalid samples:
/// an estimate of the residual's coding cost.
int hadamard_differences(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride);

}  // namespace rs::encode
