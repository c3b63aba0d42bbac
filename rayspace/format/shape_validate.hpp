#pragma once
// The part of validate_object() that looks at a ring's shape map; encode/FORMAT.md, section "Ranges".

#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace rs {

// The bounds that several parts of validate_object() share.
namespace object_ranges {

inline constexpr std::int64_t kOne_q16 = std::int64_t{1} << 16;
inline constexpr std::int64_t kOne_q20 = std::int64_t{1} << 20;
inline constexpr std::int64_t kOne_q30 = std::int64_t{1} << 30;
inline constexpr std::int64_t kMaxPixels_q16 = 16384 * kOne_q16;
inline constexpr std::int64_t kMaxDistance_q20 = 256 * kOne_q20;
inline constexpr std::int64_t kMaxHalf_q20 = 2 * kOne_q20 + kOne_q20 / 16;  // of a map, along x or p

// |number| < limit, for numbers of which INT32_MIN is one.
inline bool below(std::int32_t number, std::int64_t limit) {
    return std::abs(std::int64_t{number}) < limit;
}

// Whether cells_per_unit_q12 is cells / (2 * half), but for its own rounding and that of `half`.
inline bool is_consistent(std::int32_t cells_per_unit_q12, int cells, double half) {
    const double expected = 4096.0 * cells / (2 * half);
    return cells_per_unit_q12 > 0 && std::abs(cells_per_unit_q12 - expected) <= 1.0 + std::ldexp(expected, -20);
}

}  // namespace object_ranges

// ring.shape is empty in all its members, or has the sizes that the ring and its own numbers ask for and all numbers
// within their ranges. The ring's own numbers must have been checked. The error says what is wrong, without a place.
// Cost: one look at every cell.
Status check_shape(const Ring& ring);

}  // namespace rs
