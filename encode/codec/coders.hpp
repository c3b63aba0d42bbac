#pragma once
// Two coders for rayspace/codec/syntax.hpp: CostEstimator adds up the cost of decisions, SymbolBuffer stores decisions
// until the probabilities are known.

#include "rayspace/codec/code/contexts.hpp"
#include "rayspace/codec/kernels/transform.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace rs::encode {

using Probabilities = std::array<std::uint16_t, codec::context::kCount>;

/// Costs in bits of single decisions and of whole levels, tabulated. 48 kB. Concurrent reads are safe.
class CostTable {
public:
    static constexpr int kTabled = 16;  // levels 0 .. kTabled - 1 are tabulated
    using LevelCosts = std::array<float, kTabled>;

    explicit CostTable(const Probabilities& probabilities);
    [[nodiscard]] float of(int context, int bit) const { return bits_[static_cast<std::size_t>(2 * context + bit)]; }

    /// Costs of the magnitudes 0 .. kTabled - 1 with their signs; `must_be`: the level is known not to be 0.
    [[nodiscard]] const LevelCosts& levels(int kind, int band, int near, bool must_be) const {
        return levels_[level_row(kind, band, near, must_be)];
    }
    /// Cost of any magnitude.
    [[nodiscard]] float level(int kind, int band, int near, bool must_be, int magnitude) const {
        return magnitude < kTabled ? levels(kind, band, near, must_be)[static_cast<std::size_t>(magnitude)]
                                   : large_level(kind, band, near, must_be, magnitude);
    }
    /// Cost of the scan position of a block's last level. `kind` determines the block's size.
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

class CostEstimator {
public:
    explicit CostEstimator(const CostTable& costs) : costs_(costs) {}
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

/// A decision: context * 2 + bit. The context kCount denotes a bit of probability 1/2.
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
