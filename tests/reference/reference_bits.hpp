#pragma once
// FORMAT.md, "Bits": the binary arithmetic decoder of a tile's bytes.

#include "tests/reference/reference_chunks.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace rs::reference {

class Bits {
public:
    Bits(Bytes bytes, const std::array<int, kContexts[1]>& probability) : bytes_(bytes), probability_(probability) {
        for (int i = 0; i < 16; ++i) value_ = static_cast<std::uint16_t>(2 * value_ + next_bit());
    }

    int bit(int context) {
        return decode(16 * static_cast<unsigned>(probability_.at(static_cast<std::size_t>(context))));
    }
    int raw() { return decode(2048); }

    // "n bits, the highest first; the bit after those that so far make the number m (of k bits) has context
    // c + 2^k - 1 + m"
    int tree(int c, int n) {
        int m = 0;
        for (int k = 0; k < n; ++k) m = 2 * m + bit(c + (1 << k) - 1 + m);
        return m;
    }

    // "a length L in unary ... L = 0 and L = 1 are the numbers 0 and 1. Else the number has L bits: the highest is 1,
    // the next has context t + L, the others are raw."
    int number(int c, int places, int t) {
        int length = 0;
        while (length < places && bit(c + length) == 1) ++length;
        if (length <= 1) return length;
        int result = 2 + bit(t + length);
        for (int i = 2; i < length; ++i) result = 2 * result + raw();
        return result;
    }

private:
    // "the highest of each byte first", "followed by zeros without end"
    int next_bit() {
        const std::size_t at = position_++;
        return at / 8 < bytes_.size() ? (bytes_[at / 8] >> (7 - at % 8)) & 1 : 0;
    }

    int decode(unsigned probability) {
        const unsigned split = (range_ * probability) >> 12;
        const int result = value_ < split ? 0 : 1;
        if (result == 0) {
            range_ = split;
        } else {
            value_ = static_cast<std::uint16_t>(value_ - split);
            range_ = range_ - split;
        }
        while (range_ < 32768) {
            range_ = 2 * range_;
            value_ = static_cast<std::uint16_t>(2 * value_ + next_bit());
        }
        return result;
    }

    Bytes bytes_;
    const std::array<int, kContexts[1]>& probability_;
    std::size_t position_ = 0;
    unsigned range_ = 65535;
    std::uint16_t value_ = 0;
};

}  // namespace rs::reference
