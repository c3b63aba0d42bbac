#pragma once
// Range of a 32-bit field.

#include <cstdint>
#include <limits>

inline constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min();
inline constexpr std::int32_t kHighest = std::numeric_limits<std::int32_t>::max();
