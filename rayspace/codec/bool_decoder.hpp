#pragma once
// Binary arithmetic decoder of coded images: encode/FORMAT.md, section "Bits".
//
// Probabilities come from the caller (context_states.hpp) and are reset for every tile, so that tiles are independent.
// Reads past the end return zeros: a decoder never fails, and the syntax bounds the result of damaged bytes.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rs::codec {

/// P(bit is 0) = probability / 4096.
inline constexpr int kProbabilityBits = 12;

class BoolDecoder {
public:
    explicit BoolDecoder(std::span<const std::byte> bytes) : next_(bytes.data()), end_(bytes.data() + bytes.size()) {
        refill();
    }

    /// `probability`: 1 .. 4095.
    int bit(std::uint32_t probability) {
        const std::uint32_t split = (range_ * probability) >> kProbabilityBits;
        const std::uint64_t high_split = std::uint64_t{split} << 48;
        const bool one = value_ >= high_split;
        range_ = one ? range_ - split : split;
        value_ -= one ? high_split : 0;
        const int shift = std::countl_zero(range_) - 16;
        range_ <<= shift;
        value_ <<= shift;
        left_ -= shift;
        if (left_ < 16) refill();
        return one ? 1 : 0;
    }

private:
    // The upper 16 bits of value_ are compared; left_ counts the bits of value_ that came from the stream.
    void refill() {
        while (left_ <= 56) {
            const std::uint64_t byte = next_ != end_ ? static_cast<std::uint64_t>(*next_++) : 0;
            value_ |= byte << (56 - left_);
            left_ += 8;
        }
    }

    const std::byte* next_;
    const std::byte* end_;
    std::uint64_t value_ = 0;
    std::uint32_t range_ = 0xFFFF;
    int left_ = 0;
};

}  // namespace rs::codec
