#pragma once
// Intra and inter prediction of a unit of a coded image: from neighbours inside the tile, or from one or two other
// images. Integer and normative: encode/FORMAT.md, section "Prediction". No function allocates; all are thread-safe.

#include "rayspace/image/image.hpp"

#include <cstddef>
#include <cstdint>

namespace rs::codec {

/// Samples read before and after the position that a vector points to.
inline constexpr int kTapsBefore = 3;
inline constexpr int kTapsAfter = 4;

struct MotionVector {
    std::int16_t x = 0;  // quarters of a sample, to the right and down
    std::int16_t y = 0;
    bool operator==(const MotionVector&) const = default;
};
inline constexpr int kMaxMotion_q2 = 1023;  // largest absolute value of a component

/// Interpolates size x size samples of `plane`, the first at (x, y) + vector, into out[row * stride + column]; size 8
/// or
/// 16. Samples outside of the plane repeat its border. Separable, 8 taps.
void predict_from_image(ConstImageView<std::uint8_t> plane, int x, int y, MotionVector vector, int size,
                        std::uint8_t* out, std::ptrdiff_t stride);

/// Averages size x size samples into `a`: (a + b + 1) / 2.
void average_into(std::uint8_t* a, std::ptrdiff_t a_stride, const std::uint8_t* b, std::ptrdiff_t b_stride, int size);

inline constexpr int kIntraModes = 8;  // mean, plane, vertical, horizontal, gradient, diagonal, steep, flat

/// Intra prediction from the column left of the unit and the row above it, as available. `samples` points to the unit's
/// first sample in its plane; the prediction is written there.
void predict_from_neighbours(std::uint8_t* samples, std::ptrdiff_t stride, int size, bool has_left, bool has_above,
                             int mode);

}  // namespace rs::codec
