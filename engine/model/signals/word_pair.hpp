#pragma once
// Two numbers of 32 bits in one word of the board's memory.

#include <cstdint>

namespace rs::engine::model {

inline std::uint64_t word_pair(std::int32_t low, std::int32_t high) {
    return std::uint64_t{static_cast<std::uint32_t>(low)} | std::uint64_t{static_cast<std::uint32_t>(high)} << 32U;
}

}  // namespace rs::engine::model
