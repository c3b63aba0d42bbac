#include "engine/core/fast/shape_columns.hpp"

#include "engine/core/definition/fixed_point.hpp"
#include "engine/core/definition/shape_pixel.hpp"

#include <algorithm>
#include <cstdint>

namespace rs::engine {
namespace {

// Range of depths in which section 7's integers deviate less than half a column from the exact quotient. Nearer points
// are not visible; at farther ones the reciprocal has too few bits.
constexpr std::int64_t kMaxBracketDepth_q20 = std::int64_t{1} << 26;
constexpr std::int64_t kMaxLateral_q12 = std::int64_t{1} << 30;

// Bilinear reads need one column on either side; a second one covers rounding.
constexpr int kMargin = 2;

}  // namespace

ColumnRange sampled_columns(const RaySpaceObject& object, const ShapeImage& image) {
    const ColumnRange whole{0, object.width - 1};
    const std::int32_t cx_q8 = object.views[static_cast<std::size_t>(image.view)].cx_q16 >> 8;
    // The column is a quotient of linear functions of depth. It is between its values at both ends if the divisor is
    // positive at both.
    std::int64_t least_q8 = 0;
    std::int64_t most_q8 = 0;
    for (const int d_q3 : {0, 255 * 8}) {
        const std::int64_t l_q20 = image.l0_q20 + ((std::int64_t{d_q3} * image.l1_q24) >> 7);
        const std::int64_t n_q12 = image.n0_q12 + ((std::int64_t{d_q3} * image.n1_q12) >> 3);
        if (l_q20 < kNearest_q20 || l_q20 > kMaxBracketDepth_q20) return whole;
        if (n_q12 < -kMaxLateral_q12 || n_q12 > kMaxLateral_q12) return whole;
        const auto inverse_q20 = static_cast<std::int32_t>((std::int64_t{1} << 40) / l_q20);
        const std::int64_t column_q8 =
            std::int64_t{cx_q8} + multiply_shift(static_cast<std::int32_t>(n_q12), inverse_q20, 24);
        least_q8 = d_q3 == 0 ? column_q8 : std::min(least_q8, column_q8);
        most_q8 = d_q3 == 0 ? column_q8 : std::max(most_q8, column_q8);
    }
    const std::int64_t first = std::max<std::int64_t>((least_q8 >> 8) - kMargin, 0);
    const std::int64_t last = std::min<std::int64_t>((most_q8 >> 8) + kMargin, object.width - 1);
    if (first > last) return {};
    return {static_cast<int>(first), static_cast<int>(last)};
}

}  // namespace rs::engine
