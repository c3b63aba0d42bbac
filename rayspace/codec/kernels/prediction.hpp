#pragma once
// What a unit of a coded image is predicted from: its neighbours inside the tile, or one or two other images.
// Integer and normative: encode/FORMAT.md, section "Prediction". No function here allocates; all may be called from
// several threads at once.

#include "rayspace/image/image.hpp"

#include <cstddef>
#include <cstdint>

namespace rs::codec {

// An image's samples may be read within these many of the place that a vector points to.
inline constexpr int kTapsBefore = 3;
inline constexpr int kTapsAfter = 4;

struct MotionVector {
    std::int16_t x = 0;  // quarters of a sample, to the right and down
    std::int16_t y = 0;
    bool operator==(const MotionVector&) const = default;
};
inline constexpr int kMaxMotion_q2 = 1023;  // of either component, absolute

// size x size samples of `plane`, the first at (x, y) + vector, to out[row * stride + column]; size 8 or 16. Samples
// outside of the plane are those of its rim. Separable, 8 taps.
void predict_from_image(ConstImageView<std::uint8_t> plane, int x, int y, MotionVector vector, int size,
                        std::uint8_t* out, std::ptrdiff_t stride);

// (a + b + 1) / 2 of size x size samples, into `a`.
void average_into(std::uint8_t* a, std::ptrdiff_t a_stride, const std::uint8_t* b, std::ptrdiff_t b_stride, int size);

inline constexpr int kIntraModes = 8;  // mean, plane, vertical, horizontal, gradient, diagonal, steep, flat

// From the column left of the unit and the row above it, where there are such. `samples` points to the unit's first
// sample in its plane; the prediction is written there.
void predict_from_neighbours(std::uint8_t* samples, std::ptrdiff_t stride, int size, bool has_left, bool has_above,
                             int mode);

}  // namespace rs::codec
