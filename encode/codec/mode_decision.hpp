#pragma once
// Mode decision for one unit of a tile.

#include "encode/codec/search_kernels.hpp"
#include "encode/codec/tile_encoder.hpp"
#include "rayspace/codec/prediction_unit.hpp"
#include "rayspace/codec/reconstruct_unit.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace rs::encode {

/// Shared state of a tile's units. Masks and depths cover the whole tile; coding a unit reads only those of units
/// before it, as the decoder does.
struct TileState {
    codec::TileGrid grid;
    codec::AlphaLevels alpha;   // mask
    codec::AlphaLevels depths;  // for syntax::alpha_depth
};

class ModeDecision {
public:
    ModeDecision(const ImageTask& task, const CostTable& costs, TileState& state, int left, int top)
        : task_(task), costs_(costs), state_(state), left_(left), top_(top) {}

    /// Chooses the modes of a unit. The samples of the unit in task.out are used as scratch.
    /// \param around  choice of the macroblock as a whole, whose vectors are tried too; may be null.
    /// \return weighted squared error plus lambda * bits.
    float choose(const codec::PredictionUnit& unit, codec::UnitChoice& choice,
                 const codec::UnitChoice* around = nullptr) const;

    /// Writes the unit's decisions.
    void write(const codec::PredictionUnit& unit, codec::UnitChoice& choice, SymbolBuffer& recorder) const;

    /// Reconstructs the unit in task.out and records it in the grid.
    void commit(const codec::PredictionUnit& unit, const codec::UnitChoice& choice) const;

private:
    // A prediction of a unit.
    struct Candidate {
        codec::Source source = codec::Source::kIntra;
        int intra_mode = 0;
        std::array<codec::MotionVector, 2> motion;
        float head_cost = 0;  // lambda * bits of prediction and alpha
        float estimate = 0;   // cost estimate before coding: bits and residual, as absolute differences
        std::uint8_t predicted[codec::kPlanes][codec::kMacroblock * codec::kMacroblock];  // rows of the unit's size

        void take(const codec::UnitChoice& choice);
        void put(codec::UnitChoice& choice) const;
    };
    // Candidates of one unit: up to three inter, the rest intra.
    class Candidates {
    public:
        Candidate& add() { return all_[count_++]; }
        // The `count` candidates of the lowest estimate, best first.
        std::span<const Candidate*> select_best(int count);

    private:
        std::array<Candidate, 3 + codec::kIntraModes> all_;
        std::array<const Candidate*, 3 + codec::kIntraModes> order_{};
        std::size_t count_ = 0;
    };
    enum class Transforms : std::uint8_t { kLarge, kSmall, kBoth };  // kLarge: as large as the unit

    [[nodiscard]] codec::UnitPosition position_of(const codec::PredictionUnit& unit) const;
    [[nodiscard]] SampleBlock target_samples(const codec::UnitPosition& place, int plane) const;
    // The sum of absolute differences equivalent to one bit.
    [[nodiscard]] float bit_cost() const { return std::sqrt(task_.lambda / kPlaneWeights[0]); }
    void estimate_cost(const codec::PredictionUnit& unit, codec::UnitChoice& trial, Candidate& candidate) const;
    void evaluate(const codec::PredictionUnit& unit, const Candidate& candidate, Transforms transforms,
                  codec::UnitChoice& trial, codec::UnitChoice& choice, float& best) const;
    void add_intra(const codec::PredictionUnit& unit, codec::UnitChoice& trial, Candidates& candidates) const;
    void add_inter(const codec::PredictionUnit& unit, const codec::UnitChoice* around, codec::UnitChoice& trial,
                   Candidates& candidates) const;
    template <class Coder>
    void code_alpha(Coder& coder, const codec::PredictionUnit& unit, const codec::UnitChoice& choice) const;

    const ImageTask& task_;
    const CostTable& costs_;
    TileState& state_;
    int left_;
    int top_;
};

}  // namespace rs::encode
