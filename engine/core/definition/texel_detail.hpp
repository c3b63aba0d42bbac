#pragma once
// Section 7 of engine/RECONSTRUCTION.md: detail of stored pixels, which the sharp filter adds to bilinear samples and
// the smooth filter subtracts.
//
// With f the fraction of a texel between two pixels, cubic interpolation is linear interpolation minus f (1 - f) / 2
// times the interpolated second differences (Keys 1981, a = -1/2). The detail of a pixel is its negated second
// difference, horizontal plus vertical, of luma only, times 5/4, because blending two photos blurs, too.
// Subtracting 2/5 of it is a low-pass filter: weights 1/2 and four times 1/8.

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <algorithm>
#include <cstdint>

namespace rs::engine {

/// The detail of a pixel from its luma and its four neighbors' luma, each 0..255: 5/16 of the negated Laplacian.
constexpr std::int8_t texel_detail(int luma, int left, int right, int above, int below) {
    return static_cast<std::int8_t>(std::clamp((5 * (4 * luma - left - right - above - below) + 8) >> 4, -128, 127));
}

/// The detail of a stored pixel: 0 on the border of the image, and where the pixel or a neighbor is not opaque.
/// `luma` and `alpha` are callables of (column, row).
template <class Luma, class Alpha>
std::int8_t texel_detail_at(int width, int height, int column, int row, const Luma& luma, const Alpha& alpha) {
    if (column < 1 || column >= width - 1 || row < 1 || row >= height - 1) return 0;
    const int opaque = alpha(column, row) & alpha(column - 1, row) & alpha(column + 1, row) & alpha(column, row - 1) &
                       alpha(column, row + 1);
    if (opaque != 255) return 0;
    return texel_detail(luma(column, row), luma(column - 1, row), luma(column + 1, row), luma(column, row - 1),
                        luma(column, row + 1));
}

/// texel_detail_at() of an unpacked image.
inline std::int8_t texel_detail_at(const PlanarImage& image, int column, int row) {
    return texel_detail_at(image.y.width(), image.y.height(), column, row, image.y, image.a);
}

/// Strength of the smooth filter, 1/64.
inline constexpr int kSmoothing = 26;

/// The detail that a filter adds to a bilinear sample at fx, fy eighths between four texels.
/// \param alpha_sum   sum of weight * alpha over the four texels, 0 .. 64 * 255
/// \param detail_sum  sum of weight * detail, |.| <= 64 * 128
/// \return            in the units of SampleSum::r; at most 2^20
constexpr std::int32_t sample_detail(TexelFilter filter, int fx, int fy, std::int32_t alpha_sum,
                                     std::int32_t detail_sum) {
    int strength = 0;
    if (filter == TexelFilter::kSharp) strength = fx * (8 - fx) + fy * (8 - fy);  // 0 on texels, 32 amid four
    if (filter == TexelFilter::kSmooth) strength = -kSmoothing;
    return (alpha_sum * ((strength * detail_sum) >> 6)) >> 6;
}

}  // namespace rs::engine
