#pragma once
// The sums over samples that the encoder's search spends its time on, compiled for every SIMD target that Highway
// knows and chosen at run time; all give the same integers everywhere. No function here allocates; all may be called
// from several threads at once.

#include <cstddef>
#include <cstdint>

namespace rs::encode {

// The forward transform that codec::inverse_transform undoes: residual[y * size + x] -> coefficients[v * size + u],
// orthonormal ones times 16 (size 8) or 8 (size 16).
void forward_transform(const std::int16_t* residual, int size, std::int32_t* coefficients);

// A square of samples beside others: `size` (8 or 16) rows of `size`. The mask has 255 where a sample is valid, else 0.
struct MaskedSamples {
    const std::uint8_t* wanted = nullptr;
    const std::uint8_t* mask = nullptr;
    std::ptrdiff_t stride = 0;  // of both
    int size = 16;
};

// The sum of absolute differences over the samples that count.
int absolute_differences(const MaskedSamples& target, const std::uint8_t* samples, std::ptrdiff_t stride);

// The same of the means of two predictions, `other` (rows of the target's size) being the second.
int absolute_differences_of_mean(const MaskedSamples& target, const std::uint8_t* samples, std::ptrdiff_t stride,
                                 const std::uint8_t* other);

// The sum of their squares.
int squared_differences(const MaskedSamples& target, const std::uint8_t* samples, std::ptrdiff_t stride);

// The sum of the magnitudes of the orthonormal 8x8 Hadamard transforms of the differences, 0 where a sample does not
// count: about what is left to be coded.
int hadamard_differences(const MaskedSamples& target, const std::uint8_t* samples, std::ptrdiff_t stride);

}  // namespace rs::encode
