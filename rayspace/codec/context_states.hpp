#pragma once
// Adaptive probabilities of a tile's contexts: encode/FORMAT.md, section "Context adaptation". Every tile starts with
// the object's probability table, so that tiles are independent.

#include "rayspace/codec/adaptation.hpp"
#include "rayspace/codec/code/contexts.hpp"
#include "rayspace/codec/code/dense_code.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace rs::codec {

class ContextStates {
public:
    explicit ContextStates(const DenseCode& code) : shifts_(code.adaptation ? kAdaptationShifts : kFixed) {
        for (std::size_t c = 0; c < zero_q16_.size(); ++c) {
            zero_q16_[c] = static_cast<std::uint16_t>(code.probabilities[c] << kFractionBits);
        }
        uses_ = kFirstUses;
    }

    /// The probability of a 0 in 4096ths, for BoolDecoder.
    [[nodiscard]] std::uint32_t probability(int context) const {
        return decoder_probability(zero_q16_[static_cast<std::size_t>(context)]);
    }

    void adapt(int context, int bit) {
        const auto c = static_cast<std::size_t>(context);
        zero_q16_[c] = adapt_probability(zero_q16_[c], shifts_[uses_[c]], bit);
        uses_[c] = increment_uses(uses_[c]);
    }

private:
    // A shift that leaves the probability unchanged.
    static constexpr AdaptationShifts kFixed = [] {
        AdaptationShifts shifts{};
        shifts.fill(17);
        return shifts;
    }();

    // The number of decisions that the object's probability counts for: levels differ little from tile to tile,
    // silhouettes much.
    static constexpr std::array<std::uint8_t, context::kCount> kFirstUses = [] {
        std::array<std::uint8_t, context::kCount> uses{};
        for (int c = 0; c < context::kCount; ++c) {
            uses[static_cast<std::size_t>(c)] = c < context::kNonZero ? 16 : c < context::kAlphaZero ? 64 : 8;
        }
        return uses;
    }();

    std::array<std::uint16_t, context::kCount> zero_q16_{};
    std::array<std::uint8_t, context::kCount> uses_{};
    const AdaptationShifts& shifts_;
};

}  // namespace rs::codec
