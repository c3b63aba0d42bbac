#include "rayspace/codec/kernels/prediction.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rayspace/codec/kernels/prediction.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

// Loops of fixed lengths, vectorised by the compiler for each target.
HWY_BEFORE_NAMESPACE();
namespace rs::codec::HWY_NAMESPACE {

constexpr int kTaps = kTapsBefore + 1 + kTapsAfter;
constexpr std::int16_t kFilter[4][kTaps] = {
    {0, 0, 0, 64, 0, 0, 0, 0},
    {-1, 4, -10, 58, 17, -5, 1, 0},
    {-1, 4, -11, 40, 40, -11, 4, -1},
    {0, 1, -5, 17, 58, -10, 4, -1},
};

HWY_INLINE std::uint8_t sample_of(int value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0, 255));
}

// Filters a line of positions that are `step` samples apart, `in` being the first tap: sums in 64ths. They fit in 16
// bits, since the magnitudes of a filter's taps add up to 112.
template <int kSize>
void sum_of_taps(const std::uint8_t* in, std::ptrdiff_t step, const std::int16_t* taps, std::int16_t* sums) {
    for (int x = 0; x < kSize; ++x) {
        int sum = 0;
        for (int t = 0; t < kTaps; ++t) sum += taps[t] * in[x + t * step];
        sums[x] = static_cast<std::int16_t>(sum);
    }
}

// A single pass along rows (step 1) or columns (step: the stride); equal to two passes, since rounding 64ths of 64ths
// gives the same.
template <int kSize>
void filter_once(const std::uint8_t* in, std::ptrdiff_t in_stride, std::ptrdiff_t step, const std::int16_t* taps,
                 std::uint8_t* out, std::ptrdiff_t stride) {
    for (int y = 0; y < kSize; ++y) {
        std::int16_t sums[kSize];
        sum_of_taps<kSize>(in + y * in_stride, step, taps, sums);
        for (int x = 0; x < kSize; ++x) {
            out[y * stride + x] = sample_of((static_cast<std::int16_t>(sums[x] + 32)) >> 6);
        }
    }
}

// Filters rows of `in` (whose first sample is kTapsBefore to the left of and above the first result), then columns.
// `in` has kTaps - 1 more rows and columns than the result.
template <int kSize>
void filter(const std::uint8_t* in, std::ptrdiff_t in_stride, int fx, int fy, std::uint8_t* out,
            std::ptrdiff_t stride) {
    if (fx == 0 && fy == 0) {
        for (int y = 0; y < kSize; ++y) {
            std::memcpy(out + y * stride, in + (y + kTapsBefore) * in_stride + kTapsBefore, kSize);
        }
        return;
    }
    if (fy == 0) return filter_once<kSize>(in + kTapsBefore * in_stride, in_stride, 1, kFilter[fx], out, stride);
    if (fx == 0) return filter_once<kSize>(in + kTapsBefore, in_stride, in_stride, kFilter[fy], out, stride);
    std::int16_t rows[(kSize + kTaps - 1) * kSize];
    for (int y = 0; y < kSize + kTaps - 1; ++y) {
        sum_of_taps<kSize>(in + y * in_stride, 1, kFilter[fx], rows + y * kSize);
    }
    const std::int16_t* const v = kFilter[fy];
    for (int y = 0; y < kSize; ++y) {
        const std::int16_t* const row = rows + y * kSize;
        for (int x = 0; x < kSize; ++x) {
            std::int32_t sum = 2048;
            for (int t = 0; t < kTaps; ++t) sum += v[t] * row[x + t * kSize];
            out[y * stride + x] = sample_of(sum >> 12);
        }
    }
}

void filter_8(const std::uint8_t* in, std::ptrdiff_t in_stride, MotionVector vector, std::uint8_t* out,
              std::ptrdiff_t stride) {
    filter<8>(in, in_stride, vector.x & 3, vector.y & 3, out, stride);
}
void filter_16(const std::uint8_t* in, std::ptrdiff_t in_stride, MotionVector vector, std::uint8_t* out,
               std::ptrdiff_t stride) {
    filter<16>(in, in_stride, vector.x & 3, vector.y & 3, out, stride);
}

}  // namespace rs::codec::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rs::codec {
namespace {

constexpr int kLargest = 16;
constexpr int kTaps = kTapsBefore + 1 + kTapsAfter;

HWY_EXPORT(filter_8);
HWY_EXPORT(filter_16);

}  // namespace

void predict_from_image(ConstImageView<std::uint8_t> plane, int x, int y, MotionVector vector, int size,
                        std::uint8_t* out, std::ptrdiff_t stride) {
    const int left = x + (vector.x >> 2) - kTapsBefore;
    const int top = y + (vector.y >> 2) - kTapsBefore;
    const int span = size + kTaps - 1;
    std::uint8_t window[(kLargest + kTaps - 1) * (kLargest + kTaps - 1)];
    const std::uint8_t* in = nullptr;
    std::ptrdiff_t in_stride = 0;
    if (left >= 0 && top >= 0 && left + span <= plane.width() && top + span <= plane.height()) {
        in = plane.row(top) + left;
        in_stride = plane.stride();
    } else {
        for (int j = 0; j < span; ++j) {
            const std::uint8_t* const line = plane.row(std::clamp(top + j, 0, plane.height() - 1));
            for (int i = 0; i < span; ++i) window[j * span + i] = line[std::clamp(left + i, 0, plane.width() - 1)];
        }
        in = window;
        in_stride = span;
    }
    if (size == 8) {
        HWY_DYNAMIC_DISPATCH(filter_8)(in, in_stride, vector, out, stride);
    } else {
        HWY_DYNAMIC_DISPATCH(filter_16)(in, in_stride, vector, out, stride);
    }
}

void average_into(std::uint8_t* a, std::ptrdiff_t a_stride, const std::uint8_t* b, std::ptrdiff_t b_stride, int size) {
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            a[y * a_stride + x] = static_cast<std::uint8_t>((a[y * a_stride + x] + b[y * b_stride + x] + 1) >> 1);
        }
    }
}

void predict_from_neighbours(std::uint8_t* samples, std::ptrdiff_t stride, int size, bool has_left, bool has_above,
                             int mode) {
    // edge[size] is the corner, edge[size + 1 + i] the row above, edge[size - 1 - i] the column to the left.
    int edge[2 * kLargest + 1];
    const int* const above = edge + size + 1;
    const auto left = [&](int i) { return edge[size - 1 - i]; };
    const int of_above = has_left ? samples[-1] : 128;
    const int of_left = has_above ? samples[-stride] : 128;
    for (int i = 0; i < size; ++i) {
        edge[size + 1 + i] = has_above ? samples[i - stride] : of_above;
        edge[size - 1 - i] = has_left ? samples[i * stride - 1] : of_left;
    }
    edge[size] = has_left && has_above ? samples[-stride - 1] : has_left ? of_above : of_left;

    const int shift = size == 8 ? 3 : 4;
    int mean = 0;
    for (int i = 0; i < size; ++i) mean += edge[size + 1 + i] + edge[size - 1 - i];
    mean = (mean + size) >> (shift + 1);

    // Samples along the edge at half positions, 0 at the corner; odd positions are the mean of two samples.
    const auto along = [&](int halves) {
        const int at = size + (halves >> 1);
        return (halves & 1) != 0 ? (edge[at] + edge[at + 1] + 1) >> 1 : edge[at];
    };
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            int value = 0;
            switch (mode) {
                case 0:
                    value = mean;
                    break;
                case 1:
                    value = ((size - 1 - x) * left(y) + (x + 1) * above[size - 1] + (size - 1 - y) * above[x] +
                             (y + 1) * left(size - 1) + size) >>
                            (shift + 1);
                    break;
                case 2:
                    value = above[x];
                    break;
                case 3:
                    value = left(y);
                    break;
                case 4:
                    value = std::clamp(left(y) + above[x] - edge[size], 0, 255);
                    break;
                case 5:
                    value = edge[size + x - y];
                    break;
                case 6: {
                    const int halves = 2 * (x + 1) - (y + 1);
                    value = halves >= 0 ? along(halves) : along(2 * (2 * (x + 1) - (y + 1)));
                    break;
                }
                default: {
                    const int halves = 2 * (y + 1) - (x + 1);
                    value = halves >= 0 ? along(-halves) : along(-2 * (2 * (y + 1) - (x + 1)));
                    break;
                }
            }
            samples[y * stride + x] = static_cast<std::uint8_t>(value);
        }
    }
}

}  // namespace rs::codec
#endif  // HWY_ONCE
