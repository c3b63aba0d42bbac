#pragma once
// Integer operations of engine/RECONSTRUCTION.md.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rs::engine {

/// Quotient rounded towards minus infinity; divisor > 0.
constexpr std::int64_t floor_divide(std::int64_t dividend, std::int64_t divisor) {
    const std::int64_t quotient = dividend / divisor;
    return quotient * divisor > dividend ? quotient - 1 : quotient;
}

/// isqrt(): the largest integer whose square is at most `square`; 0 <= square < 2^63.
inline std::int64_t floor_square_root(std::int64_t square) {
    auto root = static_cast<std::int64_t>(std::sqrt(static_cast<double>(square)));
    while (root * root > square) --root;
    while (root < 3'037'000'499 && (root + 1) * (root + 1) <= square) ++root;
    return root;
}

inline constexpr std::int64_t kSaturated = (std::int64_t{1} << 29) - 1;

/// (a * b) >> shift, saturated to -2^29 .. 2^29 - 1.
constexpr std::int32_t multiply_shift(std::int32_t a, std::int32_t b, int shift) {
    return static_cast<std::int32_t>(
        std::clamp<std::int64_t>((std::int64_t{a} * b) >> shift, -kSaturated - 1, kSaturated));
}

}  // namespace rs::engine
