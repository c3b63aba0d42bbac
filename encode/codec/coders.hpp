#pragma once
// The encoder's two coders for rayspace/codec/syntax.hpp: one that adds up what decisions would cost, and one that
// keeps them until the probabilities are known.

#include "rayspace/codec/code/contexts.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::encode {

using Probabilities = std::array<std::uint16_t, codec::context::kCount>;

// What each decision costs, in bits.
class CostTable {
public:
    explicit CostTable(const Probabilities& probabilities) {
        for (std::size_t c = 0; c < probabilities.size(); ++c) {
            const double zero = probabilities[c] / 4096.0;
            bits_[2 * c] = static_cast<float>(-std::log2(zero));
            bits_[2 * c + 1] = static_cast<float>(-std::log2(1 - zero));
        }
    }
    [[nodiscard]] float of(int context, int bit) const { return bits_[static_cast<std::size_t>(2 * context + bit)]; }

private:
    std::array<float, 2 * static_cast<std::size_t>(codec::context::kCount)> bits_{};
};

class Estimator {
public:
    explicit Estimator(const CostTable& costs) : costs_(costs) {}
    int bit(int context, int value) {
        bits_ += costs_.of(context, value);
        return value;
    }
    int raw(int value) {
        bits_ += 1;
        return value;
    }
    [[nodiscard]] float bits() const { return bits_; }

private:
    const CostTable& costs_;
    float bits_ = 0;
};

// One decision: context * 2 + bit; the context kCount stands for one of even chances.
using Decision = std::uint16_t;

class SymbolBuffer {
public:
    explicit SymbolBuffer(std::vector<Decision>& decisions) : decisions_(decisions) {}
    int bit(int context, int value) {
        decisions_.push_back(static_cast<Decision>(2 * context + value));
        return value;
    }
    int raw(int value) { return bit(codec::context::kCount, value); }

private:
    std::vector<Decision>& decisions_;
};

}  // namespace rs::encode
