#pragma once
// The best choice for one unit of a tile.

#include "encode/codec/search_kernels.hpp"
#include "encode/codec/tile_encoder.hpp"
#include "rayspace/codec/prediction_unit.hpp"
#include "rayspace/codec/reconstruct_unit.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace rs::encode {

// What the units of a tile know of each other. The masks and depths are those of the whole tile: where a unit's are
// coded, only those before them are looked at, and a decoder has 0 in place of others only where they are not looked at
// either.
struct TileState {
    codec::TileGrid grid;
    codec::AlphaLevels alpha;   // mask
    codec::AlphaLevels depths;  // of syntax::alpha_depth
};

class ModeDecision {
public:
    ModeDecision(const ImageTask& task, const CostTable& costs, TileState& state, int left, int top)
        : task_(task), costs_(costs), state_(state), left_(left), top_(top) {}

    // Fills `choice`; returns its weighted squared error and lambda * bits. The samples of the unit in task.out are
    // used as scratch. `around`: the choice of the macroblock as a whole, whose vectors are tried too.
    float choose(const codec::PredictionUnit& unit, codec::UnitChoice& choice,
                 const codec::UnitChoice* around = nullptr) const;

    // Writes the unit's decisions.
    void write(const codec::PredictionUnit& unit, codec::UnitChoice& choice, SymbolBuffer& recorder) const;

    // Reconstructs the unit in task.out and enters it into the grid.
    void commit(const codec::PredictionUnit& unit, const codec::UnitChoice& choice) const;

private:
    // A way to predict a unit.
    struct Candidate {
        codec::Source source = codec::Source::kIntra;
        int intra_mode = 0;
        std::array<codec::MotionVector, 2> motion;
        float head_cost = 0;  // lambda * bits of prediction and alpha
        float estimate = 0;   // for comparing before anything is coded: bits and what is left, as absolute differences
        std::uint8_t predicted[codec::kPlanes][codec::kMacroblock * codec::kMacroblock];  // rows of the unit's size

        void take(const codec::UnitChoice& choice);
        void put(codec::UnitChoice& choice) const;
    };
    // Of one unit: three from images, the rest intra.
    class Candidates {
    public:
        Candidate& add() { return all_[count_++]; }
        // The `count` that look best, the best first.
        std::span<const Candidate*> likeliest(int count);

    private:
        std::array<Candidate, 3 + codec::kIntraModes> all_;
        std::array<const Candidate*, 3 + codec::kIntraModes> order_{};
        std::size_t count_ = 0;
    };
    enum class Transforms : std::uint8_t { kLarge, kSmall, kBoth };  // kLarge: as large as the unit

    [[nodiscard]] codec::UnitPlace place_of(const codec::PredictionUnit& unit) const;
    [[nodiscard]] MaskedSamples samples_of(const codec::UnitPlace& place, int plane) const;
    // The sum of absolute differences that a bit is worth.
    [[nodiscard]] float bit_cost() const { return std::sqrt(task_.lambda / kPlaneWeights[0]); }
    void weigh(const codec::PredictionUnit& unit, codec::UnitChoice& trial, Candidate& candidate) const;
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
