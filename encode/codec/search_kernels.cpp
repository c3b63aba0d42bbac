#include "encode/codec/search_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encode/codec/search_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "rayspace/codec/kernels/transform.hpp"

#include <cstdlib>

// Loops of fixed lengths, vectorised by the compiler for each target.
HWY_BEFORE_NAMESPACE();
namespace rs::encode::HWY_NAMESPACE {

template <int kSize>
void forward(const std::int16_t* residual, std::int32_t* coefficients) {
    constexpr int kRowStep = codec::kLargestTransform / kSize;
    constexpr int kLog2 = kSize == 8 ? 3 : 4;
    constexpr int kFirstShift = kLog2 - 1;
    constexpr int kSecondShift = kLog2 + 6;
    std::int32_t turned[kSize * kSize];  // [x][v]
    for (int v = 0; v < kSize; ++v) {
        std::int32_t sums[kSize] = {};
        for (int y = 0; y < kSize; ++y) {
            const std::int32_t factor = codec::kTransform16[v * kRowStep][y];
            for (int x = 0; x < kSize; ++x) sums[x] += factor * residual[y * kSize + x];
        }
        for (int x = 0; x < kSize; ++x) turned[x * kSize + v] = (sums[x] + (1 << (kFirstShift - 1))) >> kFirstShift;
    }
    for (int u = 0; u < kSize; ++u) {
        std::int32_t sums[kSize] = {};
        for (int x = 0; x < kSize; ++x) {
            const std::int32_t factor = codec::kTransform16[u * kRowStep][x];
            for (int v = 0; v < kSize; ++v) sums[v] += factor * turned[x * kSize + v];
        }
        for (int v = 0; v < kSize; ++v) {
            coefficients[v * kSize + u] = (sums[v] + (1 << (kSecondShift - 1))) >> kSecondShift;
        }
    }
}

template <int kSize>
int absolute(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride) {
    int sum = 0;
    for (int y = 0; y < kSize; ++y) {
        const std::uint8_t* const wanted = target.wanted + y * target.stride;
        const std::uint8_t* const mask = target.mask + y * target.stride;
        for (int x = 0; x < kSize; ++x) {
            sum += std::abs((wanted[x] & mask[x]) - (samples[y * stride + x] & mask[x]));
        }
    }
    return sum;
}

template <int kSize>
int absolute_of_mean(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride,
                     const std::uint8_t* other) {
    int sum = 0;
    for (int y = 0; y < kSize; ++y) {
        const std::uint8_t* const wanted = target.wanted + y * target.stride;
        const std::uint8_t* const mask = target.mask + y * target.stride;
        for (int x = 0; x < kSize; ++x) {
            const int mean = (samples[y * stride + x] + other[y * kSize + x] + 1) >> 1;
            sum += std::abs((wanted[x] & mask[x]) - (mean & mask[x]));
        }
    }
    return sum;
}

template <int kSize>
int squared(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride) {
    int sum = 0;
    for (int y = 0; y < kSize; ++y) {
        const std::uint8_t* const wanted = target.wanted + y * target.stride;
        const std::uint8_t* const mask = target.mask + y * target.stride;
        for (int x = 0; x < kSize; ++x) {
            const int off = (wanted[x] & mask[x]) - (samples[y * stride + x] & mask[x]);
            sum += off * off;
        }
    }
    return sum;
}

// One pass over eight lines of eight samples each.
HWY_INLINE void butterflies(std::int16_t* lines) {
    for (int distance = 4; distance > 0; distance /= 2) {
        for (int first = 0; first < 8; ++first) {
            if ((first & distance) != 0) continue;
            std::int16_t* const a = lines + first * 8;
            std::int16_t* const b = lines + (first + distance) * 8;
            for (int i = 0; i < 8; ++i) {
                const auto sum = static_cast<std::int16_t>(a[i] + b[i]);
                b[i] = static_cast<std::int16_t>(a[i] - b[i]);
                a[i] = sum;
            }
        }
    }
}

template <int kSize>
int hadamard(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride) {
    int sum = 0;
    for (int block = 0; block < kSize * kSize / 64; ++block) {
        const std::ptrdiff_t down = 8 * (block / 2);
        const std::ptrdiff_t right = 8 * (block % 2);
        std::int16_t off[64];
        for (int y = 0; y < 8; ++y) {
            const std::uint8_t* const wanted = target.wanted + (down + y) * target.stride + right;
            const std::uint8_t* const mask = target.mask + (down + y) * target.stride + right;
            const std::uint8_t* const other = samples + (down + y) * stride + right;
            for (int x = 0; x < 8; ++x) {
                off[8 * y + x] = static_cast<std::int16_t>((wanted[x] & mask[x]) - (other[x] & mask[x]));
            }
        }
        butterflies(off);
        std::int16_t turned[64];
        for (int y = 0; y < 8; ++y) {
            for (int x = 0; x < 8; ++x) turned[8 * x + y] = off[8 * y + x];
        }
        butterflies(turned);
        int magnitudes = 0;
        for (const std::int16_t t : turned) magnitudes += std::abs(t);
        sum += (magnitudes + 4) >> 3;
    }
    return sum;
}

void forward_8(const std::int16_t* residual, std::int32_t* coefficients) {
    forward<8>(residual, coefficients);
}
void forward_16(const std::int16_t* residual, std::int32_t* coefficients) {
    forward<16>(residual, coefficients);
}
int absolute_any(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride) {
    return target.size == 8 ? absolute<8>(target, samples, stride) : absolute<16>(target, samples, stride);
}
int absolute_of_mean_any(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride,
                         const std::uint8_t* other) {
    return target.size == 8 ? absolute_of_mean<8>(target, samples, stride, other)
                            : absolute_of_mean<16>(target, samples, stride, other);
}
int squared_any(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride) {
    return target.size == 8 ? squared<8>(target, samples, stride) : squared<16>(target, samples, stride);
}
int hadamard_any(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride) {
    return target.size == 8 ? hadamard<8>(target, samples, stride) : hadamard<16>(target, samples, stride);
}

}  // namespace rs::encode::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::encode {

HWY_EXPORT(forward_8);
HWY_EXPORT(forward_16);
HWY_EXPORT(absolute_any);
HWY_EXPORT(absolute_of_mean_any);
HWY_EXPORT(squared_any);
HWY_EXPORT(hadamard_any);

void forward_transform(const std::int16_t* residual, int size, std::int32_t* coefficients) {
    if (size == 8) {
        HWY_DYNAMIC_DISPATCH(forward_8)(residual, coefficients);
    } else {
        HWY_DYNAMIC_DISPATCH(forward_16)(residual, coefficients);
    }
}

int absolute_differences(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride) {
    return HWY_DYNAMIC_DISPATCH(absolute_any)(target, samples, stride);
}

int absolute_differences_of_mean(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride,
                                 const std::uint8_t* other) {
    return HWY_DYNAMIC_DISPATCH(absolute_of_mean_any)(target, samples, stride, other);
}

int squared_differences(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride) {
    return HWY_DYNAMIC_DISPATCH(squared_any)(target, samples, stride);
}

int hadamard_differences(const SampleBlock& target, const std::uint8_t* samples, std::ptrdiff_t stride) {
    return HWY_DYNAMIC_DISPATCH(hadamard_any)(target, samples, stride);
}

}  // namespace rs::encode
#endif  // HWY_ONCE
