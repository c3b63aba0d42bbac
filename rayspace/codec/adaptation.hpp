#pragma once
// Adaptation of probabilities: encode/FORMAT.md, section "Context adaptation".

#include "rayspace/codec/bool_decoder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace rs::codec {

inline constexpr int kFractionBits = 16 - kProbabilityBits;  // extra bits of a probability in 65536ths
inline constexpr std::uint8_t kMostUses = 255;

/// Adaptation shifts by the number of decisions of a context: floor(log2(uses)).
using AdaptationShifts = std::array<std::uint8_t, kMostUses + 1>;
inline constexpr AdaptationShifts kAdaptationShifts = [] {
    AdaptationShifts shifts{};
    for (unsigned n = 1; n < shifts.size(); ++n) shifts[n] = static_cast<std::uint8_t>(std::bit_width(n) - 1);
    return shifts;
}();

/// The probability of a 0 in 4096ths, for BoolDecoder.
inline std::uint32_t decoder_probability(std::uint16_t zero_q16) {
    constexpr std::uint32_t kLeast = 8;
    return std::clamp(std::uint32_t{zero_q16} >> kFractionBits, kLeast, (1U << kProbabilityBits) - kLeast);
}

/// Updates the probability of a 0 after a decision.
inline std::uint16_t adapt_probability(std::uint16_t zero_q16, unsigned shift, int bit) {
    const std::uint32_t p = zero_q16;
    const std::uint32_t more = p + ((65536U - p) >> shift);
    const std::uint32_t less = p - (p >> shift);
    return static_cast<std::uint16_t>(bit == 0 ? more : less);
}

/// The number of decisions of a context, after one more, saturated.
inline std::uint8_t increment_uses(std::uint8_t uses) {
    return static_cast<std::uint8_t>(uses + (uses < kMostUses ? 1 : 0));
}

}  // namespace rs::codec
