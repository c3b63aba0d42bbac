#pragma once
// Binary arithmetic encoder for bool_decoder.hpp.

#include "rayspace/codec/bool_decoder.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::codec {

class BoolEncoder {
public:
    /// `probability`: probability of a 0 in 4096ths, 1 .. 4095.
    void bit(int value, std::uint32_t probability) {
        const std::uint32_t split = (range_ * probability) >> kProbabilityBits;
        if (value != 0) {
            low_ += split;
            range_ -= split;
        } else {
            range_ = split;
        }
        const int shift = std::countl_zero(range_) - 16;
        range_ <<= shift;
        low_ <<= shift;
        pending_bits_ += shift;
        while (pending_bits_ >= 8) put_byte();
    }

    /// Returns the shortest bytes that decode to the written decisions. The encoder must not be used afterwards.
    std::vector<std::byte> finish() {
        for (int zeros = 16; zeros >= 0; --zeros) {
            const std::uint64_t mask = (std::uint64_t{1} << zeros) - 1;
            const std::uint64_t chosen = (low_ + mask) & ~mask;
            if (chosen > low_ + range_ - 1) continue;
            low_ = chosen;
            break;
        }
        for (int i = 0; i < 3; ++i) {
            low_ <<= 8;
            pending_bits_ += 8;
            put_byte();
        }
        while (!bytes_.empty() && bytes_.back() == std::byte{0}) bytes_.pop_back();
        return std::move(bytes_);
    }

private:
    // low_ has 16 + pending_bits_ bits, and possibly a carry above.
    void put_byte() {
        const int below = 16 + pending_bits_ - 8;
        const std::uint64_t top = low_ >> below;
        if (top > 0xFF) {
            std::size_t at = bytes_.size();
            while (bytes_[--at] == std::byte{0xFF}) bytes_[at] = std::byte{0};
            bytes_[at] = static_cast<std::byte>(static_cast<unsigned>(bytes_[at]) + 1);
        }
        bytes_.push_back(static_cast<std::byte>(top & 0xFF));
        low_ &= (std::uint64_t{1} << below) - 1;
        pending_bits_ -= 8;
    }

    std::vector<std::byte> bytes_;
    std::uint64_t low_ = 0;
    std::uint32_t range_ = 0xFFFF;
    int pending_bits_ = 0;
};

}  // namespace rs::codec
