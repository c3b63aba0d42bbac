#pragma once
// Range checks shared by the chunks' parts of validate_object(); encode/FORMAT.md, section "Ranges".

#include "rayspace/base/conventions.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace rs::object_ranges {

inline constexpr std::int64_t kOne_q16 = std::int64_t{1} << 16;
inline constexpr std::int64_t kOne_q20 = std::int64_t{1} << 20;
inline constexpr std::int64_t kOne_q30 = std::int64_t{1} << 30;
inline constexpr std::int64_t kMaxPixels_q16 = 16384 * kOne_q16;
inline constexpr std::int64_t kMaxDistance_q20 = 256 * kOne_q20;
inline constexpr std::int64_t kMaxHalf_q20 = 2 * kOne_q20 + kOne_q20 / 16;  // half width of a map along x or p

/// |number| < limit, also for INT32_MIN.
inline bool below(std::int32_t number, std::int64_t limit) {
    return std::abs(std::int64_t{number}) < limit;
}

/// True for valid sides of a map or a shape map's line, in cells.
inline bool is_map_side(int side) {
    return side >= 1 && side <= kMaxMapSide;
}

/// True if cells_per_unit_q12 equals cells / (2 * half), up to the rounding of both.
inline bool is_consistent(std::int32_t cells_per_unit_q12, int cells, double half) {
    const double expected = 4096.0 * cells / (2 * half);
    return cells_per_unit_q12 > 0 && std::abs(cells_per_unit_q12 - expected) <= 1.0 + std::ldexp(expected, -20);
}

/// [view]: true for views of the first `rings` rings, whose view lists must have been checked.
inline std::vector<bool> ring_membership(const RaySpaceObject& object, std::size_t rings) {
    std::vector<bool> is_in(object.views.size());
    for (std::size_t r = 0; r < rings; ++r) {
        for (const std::uint16_t view : object.rings[r].views) is_in[view] = true;
    }
    return is_in;
}

}  // namespace rs::object_ranges
