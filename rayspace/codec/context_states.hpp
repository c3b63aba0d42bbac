#pragma once
// What a tile's decisions so far make likely: encode/FORMAT.md, section "Context adaptation". Every tile begins with
// the probabilities of the object's table, so tiles stay independent of each other.

#include "rayspace/codec/bool_decoder.hpp"
#include "rayspace/codec/code/contexts.hpp"
#include "rayspace/codec/code/dense_code.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace rs::codec {

class ContextStates {
public:
    explicit ContextStates(const DenseCode& code) : shifts_(code.adaptation ? kAdaptation : kFixed) {
        for (std::size_t c = 0; c < zero_q16_.size(); ++c) {
            zero_q16_[c] = static_cast<std::uint16_t>(code.probabilities[c] << kFractionBits);
        }
        uses_ = kFirstUses;
    }

    // Of a 0, in 4096ths; for BoolDecoder.
    [[nodiscard]] std::uint32_t probability(int context) const {
        const std::uint32_t p = std::uint32_t{zero_q16_[static_cast<std::size_t>(context)]} >> kFractionBits;
        return std::clamp(p, kLeast, (1U << kProbabilityBits) - kLeast);
    }

    void learn(int context, int bit) {
        const auto c = static_cast<std::size_t>(context);
        const std::uint32_t p = zero_q16_[c];
        const unsigned shift = shifts_[uses_[c]];
        const std::uint32_t more = p + ((65536U - p) >> shift);
        const std::uint32_t less = p - (p >> shift);
        zero_q16_[c] = static_cast<std::uint16_t>(bit == 0 ? more : less);
        uses_[c] = static_cast<std::uint8_t>(uses_[c] + (uses_[c] < kMostUses ? 1 : 0));
    }

private:
    static constexpr int kFractionBits = 16 - kProbabilityBits;
    static constexpr std::uint32_t kLeast = 8;
    static constexpr std::uint8_t kMostUses = 255;

    using Shifts = std::array<std::uint8_t, 256>;
    // floor(log2(uses)), or so far that nothing changes.
    static constexpr Shifts kAdaptation = [] {
        Shifts shifts{};
        for (unsigned n = 1; n < shifts.size(); ++n) shifts[n] = static_cast<std::uint8_t>(std::bit_width(n) - 1);
        return shifts;
    }();
    static constexpr Shifts kFixed = [] {
        Shifts shifts{};
        shifts.fill(17);
        return shifts;
    }();

    // How many decisions the object's probability counts for: levels differ little from tile to tile, outlines much.
    static constexpr std::array<std::uint8_t, context::kCount> kFirstUses = [] {
        std::array<std::uint8_t, context::kCount> uses{};
        for (int c = 0; c < context::kCount; ++c) {
            uses[static_cast<std::size_t>(c)] = c < context::kNonZero ? 16 : c < context::kAlphaZero ? 64 : 8;
        }
        return uses;
    }();

    std::array<std::uint16_t, context::kCount> zero_q16_{};
    std::array<std::uint8_t, context::kCount> uses_{};
    const Shifts& shifts_;
};

}  // namespace rs::codec
