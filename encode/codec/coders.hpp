#pragma once
// The encoder's two coders for rayspace/codec/syntax.hpp: one that adds up what decisions would cost, and one that
// keeps them until the probabilities are known.

#include "rayspace/codec/code/contexts.hpp"
#include "rayspace/codec/kernels/transform.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace rs::encode {

using Probabilities = std::array<std::uint16_t, codec::context::kCount>;

// What each decision costs, in bits, and what levels cost as a whole. 48 kB; to be read by several threads at once.
class CostTable {
public:
    static constexpr int kTabled = 16;  // levels 0 .. kTabled - 1 have a table
    using LevelCosts = std::array<float, kTabled>;

    explicit CostTable(const Probabilities& probabilities);
    [[nodiscard]] float of(int context, int bit) const { return bits_[static_cast<std::size_t>(2 * context + bit)]; }

    // Of the magnitudes 0 .. kTabled - 1 with their signs; `must_be`: known not to be 0.
    [[nodiscard]] const LevelCosts& levels(int kind, int band, int near, bool must_be) const {
        return levels_[level_row(kind, band, near, must_be)];
    }
    // The same of any magnitude.
    [[nodiscard]] float level(int kind, int band, int near, bool must_be, int magnitude) const {
        return magnitude < kTabled ? levels(kind, band, near, must_be)[static_cast<std::size_t>(magnitude)]
                                   : large_level(kind, band, near, must_be, magnitude);
    }
    // Of the scan place of a block's last level; the kind states how large the block is.
    [[nodiscard]] float last_place(int kind, int place) const {
        return last_[static_cast<std::size_t>(kPlaces * kind + place)];
    }

private:
    static constexpr int kPlaces = codec::kLargestTransform * codec::kLargestTransform;
    static constexpr std::size_t kLevelRows =
        std::size_t{2} * codec::context::kBlockKinds * codec::context::kBands * codec::context::kNearSums;
    static constexpr std::size_t level_row(int kind, int band, int near, bool must_be) {
        return static_cast<std::size_t>(
            ((kind * codec::context::kBands + band) * codec::context::kNearSums + near) * 2 + (must_be ? 1 : 0));
    }
    [[nodiscard]] float large_level(int kind, int band, int near, bool must_be, int magnitude) const;

    std::array<float, 2 * static_cast<std::size_t>(codec::context::kCount)> bits_{};
    std::array<LevelCosts, kLevelRows> levels_{};
    std::array<float, static_cast<std::size_t>(codec::context::kBlockKinds* kPlaces)> last_{};
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
