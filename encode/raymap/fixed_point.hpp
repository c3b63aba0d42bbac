#pragma once
// Numbers as the file writes them.

#include <cmath>
#include <cstdint>

namespace rs::encode {

// The nearest multiple of 2^-fractional_bits, as a whole number of them. The value must fit. Thread-safe.
inline std::int32_t fixed_point(double value, int fractional_bits) {
    return static_cast<std::int32_t>(std::lround(std::ldexp(value, fractional_bits)));
}

}  // namespace rs::encode
