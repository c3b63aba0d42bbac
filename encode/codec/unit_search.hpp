#pragma once
// The best choice for one part of a tile.

#include "encode/codec/tile_encoder.hpp"
#include "rayspace/codec/prediction_unit.hpp"
#include "rayspace/codec/reconstruct_unit.hpp"

namespace rs::encode {

// What the parts of a tile know of each other. The masks and depths are those of the whole tile: where a part's are
// coded, only those before them are looked at, and a decoder has 0 in place of others only where they are not looked at
// either.
struct TileState {
    codec::TileGrid grid;
    codec::AlphaLevels alpha;   // mask
    codec::AlphaLevels depths;  // of syntax::alpha_depth
};

class UnitSearch {
public:
    UnitSearch(const PictureTask& task, const CostTable& costs, TileState& state, int left, int top)
        : task_(task), costs_(costs), state_(state), left_(left), top_(top) {}

    // Fills `choice`; returns its weighted squared error and lambda * bits. The samples of the part in task.out are
    // used as scratch. `around`: the choice of the macroblock as a whole, whose vectors are tried too.
    float choose(const codec::PredictionUnit& part, codec::PartChoice& choice,
                 const codec::PartChoice* around = nullptr) const;

    // Writes the part's decisions.
    void write(const codec::PredictionUnit& part, codec::PartChoice& choice, SymbolBuffer& recorder) const;

    // Reconstructs the part in task.out and enters it into the grid.
    void commit(const codec::PredictionUnit& part, const codec::PartChoice& choice) const;

private:
    [[nodiscard]] codec::PartPlace place_of(const codec::PredictionUnit& part) const;
    float evaluate(const codec::PredictionUnit& part, codec::PartChoice& choice, float best) const;
    void find_intra(const codec::PredictionUnit& part, codec::PartChoice& trial, codec::PartChoice& choice,
                    float& best) const;
    void find_inter(const codec::PredictionUnit& part, const codec::PartChoice* around, codec::PartChoice& trial,
                    codec::PartChoice& choice, float& best) const;
    template <class Coder>
    void code_alpha(Coder& coder, const codec::PredictionUnit& part, const codec::PartChoice& choice) const;

    const PictureTask& task_;
    const CostTable& costs_;
    TileState& state_;
    int left_;
    int top_;
};

}  // namespace rs::encode
