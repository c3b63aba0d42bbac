#pragma once
// FORMAT.md, "Bits" and "Context adaptation": the binary arithmetic decoder of a tile or a shape map.

#include "tests/reference/decoder/reference_chunks.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>

namespace rs::reference {

/// "Context adaptation": state of one context within a tile.
class AdaptiveContext {
public:
    AdaptiveContext() = default;
    /// "z = 256 p of its listed probability p (128 where it is not listed)"
    AdaptiveContext(int context, int listed_probability) : z_(256 * listed_probability), n_(first_count(context)) {}

    static AdaptiveContext of(int z, int n) {
        AdaptiveContext context;
        context.z_ = z;
        context.n_ = n;
        return context;
    }

    /// "P = z >> 4, held within 8 .. 4088"
    int probability() const { return std::clamp(z_ >> 4, 8, 4088); }

    /// "with s = floor(log2 n), z becomes z + ((65536 - z) >> s) if it is 0, z - (z >> s) if it is 1; and n grows by 1,
    /// to 255 at most": s is that of n before it grows.
    void adapt(int bit) {
        const int s = static_cast<int>(std::bit_width(static_cast<unsigned>(n_))) - 1;
        z_ = bit == 0 ? z_ + ((65536 - z_) >> s) : z_ - (z_ >> s);
        n_ = std::min(n_ + 1, 255);
    }

private:
    // "16 for contexts below 319, 64 for those from 319 to 750, 8 for those from 751 on"
    static int first_count(int context) { return context < 319 ? 16 : context <= 750 ? 64 : 8; }

    int z_ = 0;
    int n_ = 1;
};

/// "it keeps range ... and value ...", and reads bits of given probabilities.
class ArithmeticDecoder {
public:
    explicit ArithmeticDecoder(Bytes bytes) : bytes_(bytes) {
        for (int i = 0; i < 16; ++i) value_ = static_cast<std::uint16_t>(2 * value_ + next_bit());
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

private:
    // "the highest of each byte first", "followed by zeros without end"
    int next_bit() {
        const std::size_t at = position_++;
        return at / 8 < bytes_.size() ? (bytes_[at / 8] >> (7 - at % 8)) & 1 : 0;
    }

    Bytes bytes_;
    std::size_t position_ = 0;
    unsigned range_ = 65535;
    std::uint16_t value_ = 0;
};

/// Reads one tile: "At the beginning of every tile" adaptation starts anew.
class Bits {
public:
    Bits(Bytes bytes, const std::array<int, kContexts[1]>& probability, bool is_adaptive)
        : decoder_(bytes), probability_(probability), is_adaptive_(is_adaptive) {
        for (std::size_t context = 0; context < adaptive_.size(); ++context) {
            adaptive_[context] = AdaptiveContext(static_cast<int>(context), probability[context]);
        }
    }

    int bit(int context) {
        const std::size_t c = static_cast<std::size_t>(context);
        if (!is_adaptive_) return decoder_.decode(16 * static_cast<unsigned>(probability_.at(c)));
        AdaptiveContext& adaptive = adaptive_.at(c);
        const int result = decoder_.decode(static_cast<unsigned>(adaptive.probability()));
        adaptive.adapt(result);
        return result;
    }
    /// "Raw bits teach nothing."
    int raw() { return decoder_.decode(2048); }

    /// "n bits, the highest first; the bit after those that so far make the number m (of k bits) has context
    /// c + 2^k - 1 + m"
    int tree(int c, int n) {
        int m = 0;
        for (int k = 0; k < n; ++k) m = 2 * m + bit(c + (1 << k) - 1 + m);
        return m;
    }

    /// "a length L in unary ... L = 0 and L = 1 are the numbers 0 and 1. Else the number has L bits: the highest is 1,
    /// the next has context t + L, the others are raw."
    int number(int c, int places, int t) {
        int length = 0;
        while (length < places && bit(c + length) == 1) ++length;
        if (length <= 1) return length;
        int result = 2 + bit(t + length);
        for (int i = 2; i < length; ++i) result = 2 * result + raw();
        return result;
    }

private:
    ArithmeticDecoder decoder_;
    const std::array<int, kContexts[1]>& probability_;
    bool is_adaptive_;
    std::array<AdaptiveContext, kContexts[1]> adaptive_;
};

/// Contexts of any kind, which "begin with z = 32768 and n = 2".
class AdaptingBits {
public:
    using Name = std::array<int, 4>;

    explicit AdaptingBits(Bytes bytes) : decoder_(bytes) {}

    int bit(const Name& context) {
        AdaptiveContext& adaptive = adaptive_.try_emplace(context, AdaptiveContext::of(32768, 2)).first->second;
        const int result = decoder_.decode(static_cast<unsigned>(adaptive.probability()));
        adaptive.adapt(result);
        return result;
    }
    int raw() { return decoder_.decode(2048); }

private:
    ArithmeticDecoder decoder_;
    std::map<Name, AdaptiveContext> adaptive_;
};

}  // namespace rs::reference
