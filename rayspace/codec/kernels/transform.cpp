#include "rayspace/codec/kernels/transform.hpp"

#include <algorithm>

namespace rs::codec {

const std::int8_t kTransform16[16][16] = {
    {64, 64, 64, 64, 64, 64, 64, 64, 64, 64, 64, 64, 64, 64, 64, 64},
    {90, 87, 80, 70, 57, 43, 25, 9, -9, -25, -43, -57, -70, -80, -87, -90},
    {89, 75, 50, 18, -18, -50, -75, -89, -89, -75, -50, -18, 18, 50, 75, 89},
    {87, 57, 9, -43, -80, -90, -70, -25, 25, 70, 90, 80, 43, -9, -57, -87},
    {83, 36, -36, -83, -83, -36, 36, 83, 83, 36, -36, -83, -83, -36, 36, 83},
    {80, 9, -70, -87, -25, 57, 90, 43, -43, -90, -57, 25, 87, 70, -9, -80},
    {75, -18, -89, -50, 50, 89, 18, -75, -75, 18, 89, 50, -50, -89, -18, 75},
    {70, -43, -87, 9, 90, 25, -80, -57, 57, 80, -25, -90, -9, 87, 43, -70},
    {64, -64, -64, 64, 64, -64, -64, 64, 64, -64, -64, 64, 64, -64, -64, 64},
    {57, -80, -25, 90, -9, -87, 43, 70, -70, -43, 87, 9, -90, 25, 80, -57},
    {50, -89, 18, 75, -75, -18, 89, -50, -50, 89, -18, -75, 75, 18, -89, 50},
    {43, -90, 57, 25, -87, 70, 9, -80, 80, -9, -70, 87, -25, -57, 90, -43},
    {36, -83, 83, -36, -36, 83, -83, 36, 36, -83, 83, -36, -36, 83, -83, 36},
    {25, -70, 90, -80, 43, 9, -57, 87, -87, 57, -9, -43, 80, -90, 70, -25},
    {18, -50, 75, -89, 89, -75, 50, -18, -18, 50, -75, 89, -89, 75, -50, 18},
    {9, -25, 43, -57, 70, -80, 87, -90, 90, -87, 80, -70, 57, -43, 25, -9},
};

namespace {

constexpr int kFirstShift = 7;
constexpr int kSecondShift = 12;

std::int16_t clamped(int value) {
    return static_cast<std::int16_t>(std::clamp(value, -32768, 32767));
}

// Column pass: out[i][x] = sum over k < used of matrix[k][i] * in[k][x], for the first kWidth columns; rows of `in` and
// `out` are kSize apart. Even rows of the matrix are symmetric and odd ones antisymmetric, so that results i and kSize
// - 1 - i share their products. The sums stay below 2^31: 16 * 90 * 2^15.
template <int kSize, int kWidth>
void pass(const std::int16_t* in, int used, int shift, std::int16_t* out) {
    constexpr int kRowStep = kLargestTransform / kSize;
    for (int i = 0; i < kSize / 2; ++i) {
        std::int32_t even[kWidth];
        std::int32_t odd[kWidth] = {};
        std::fill_n(even, kWidth, 1 << (shift - 1));
        for (int k = 0; k < used; k += 2) {
            const std::int32_t factor = kTransform16[k * kRowStep][i];
            for (int x = 0; x < kWidth; ++x) even[x] += factor * in[k * kSize + x];
        }
        for (int k = 1; k < used; k += 2) {
            const std::int32_t factor = kTransform16[k * kRowStep][i];
            for (int x = 0; x < kWidth; ++x) odd[x] += factor * in[k * kSize + x];
        }
        for (int x = 0; x < kWidth; ++x) {
            out[i * kSize + x] = clamped((even[x] + odd[x]) >> shift);
            out[(kSize - 1 - i) * kSize + x] = clamped((even[x] - odd[x]) >> shift);
        }
    }
}

// kWidth: `used` or more.
template <int kSize, int kWidth>
void inverse(const std::int16_t* coefficients, int used, std::int16_t* residual) {
    std::int16_t columns[kSize * kSize];
    pass<kSize, kWidth>(coefficients, used, kFirstShift, columns);
    // The row pass adds up whole rows of the matrix, so that no transposition is needed.
    for (int y = 0; y < kSize; ++y) {
        std::int32_t sums[kSize];
        std::fill_n(sums, kSize, 1 << (kSecondShift - 1));
        for (int k = 0; k < used; ++k) {
            const std::int16_t factor = columns[y * kSize + k];
            const std::int8_t* const row = kTransform16[k * (kLargestTransform / kSize)];
            for (int x = 0; x < kSize; ++x) sums[x] += factor * row[x];
        }
        for (int x = 0; x < kSize; ++x) residual[y * kSize + x] = clamped(sums[x] >> kSecondShift);
    }
}

}  // namespace

void inverse_transform(const std::int16_t* coefficients, int size, int used, std::int16_t* residual) {
    if (used == 1) {
        // Both passes for the DC coefficient only.
        const std::int16_t first = clamped((64 * coefficients[0] + (1 << (kFirstShift - 1))) >> kFirstShift);
        const std::int16_t mean = clamped((64 * first + (1 << (kSecondShift - 1))) >> kSecondShift);
        std::fill_n(residual, size * size, mean);
    } else if (size == 8) {
        inverse<8, 8>(coefficients, used, residual);
    } else if (used <= 8) {
        inverse<16, 8>(coefficients, used, residual);
    } else {
        inverse<16, 16>(coefficients, used, residual);
    }
}

std::int16_t dequantise(int level, int step, int size) {
    // step_q4 / 16 * 16 for size 8; half of that, with halves rounded up, for size 16.
    const int product = std::clamp(level, -32767, 32767) * step_q4(step);
    return clamped(size == 8 ? product : (product + 1) >> 1);
}

}  // namespace rs::codec
