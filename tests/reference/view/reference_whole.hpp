#pragma once
// The arithmetic of engine/RECONSTRUCTION.md, "Notation", in integers that cannot overflow, and the bounds of its
// section "Ranges" as checks.

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace rs::reference {

__extension__ using Whole = __int128;

constexpr Whole power(int exponent) {
    return Whole{1} << exponent;
}

/// Thrown if a number exceeds a bound of "Ranges".
class OutOfRange : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

inline void require(bool is_within, const char* what, Whole value) {
    if (is_within) return;
    throw OutOfRange(std::string(what) + " is out of its range: " + std::to_string(static_cast<double>(value)));
}

/// "|value| < 2^exponent"
inline Whole below(Whole value, double exponent, const char* what) {
    const long double size = static_cast<long double>(value < 0 ? -value : value);
    require(size < std::exp2(static_cast<long double>(exponent)), what, value);
    return value;
}

/// "|value| <= 2^exponent"
inline Whole at_most(Whole value, int exponent, const char* what) {
    require(value >= -power(exponent) && value <= power(exponent), what, value);
    return value;
}

/// "low <= value <= high"
inline Whole within(Whole value, Whole low, Whole high, const char* what) {
    require(value >= low && value <= high, what, value);
    return value;
}

/// "N bits", including the sign.
inline Whole in_bits(Whole value, int bits, const char* what) {
    return within(value, -power(bits - 1), power(bits - 1) - 1, what);
}

constexpr Whole floor_div(Whole a, Whole b) {
    const Whole quotient = a / b;
    return quotient - ((a % b != 0 && (a < 0) != (b < 0)) ? 1 : 0);
}

constexpr Whole clamp(Whole a, Whole low, Whole high) {
    if (a < low) return low;
    return a > high ? high : a;
}

constexpr Whole hold(Whole a) {
    return clamp(a, -power(29), power(29) - 1);
}

/// For the rows of "Ranges" that say "never held".
inline Whole never_held(Whole a, const char* what) {
    return within(a, -power(29), power(29) - 1, what);
}

/// Computes bit by bit from the top, for a below 2^64.
constexpr Whole isqrt(Whole a) {
    Whole root = 0;
    for (int bit = 31; bit >= 0; --bit) {
        const Whole tried = root + power(bit);
        if (tried * tried <= a) root = tried;
    }
    return root;
}

}  // namespace rs::reference
