#pragma once
// Column set-up: of a column's ray everything that its pixels share. Without a shape map the walk of
// vertical_compensation, in its time; with one section 5 of RECONSTRUCTION.md, with one pipelined multiplier (P, a
// product a cycle), one pipelined divider (D) and one unit for square roots (R):
//
//     cycle  1         take the ray                             78..83    P: p = x * cosine
//            2..8      P: n * n, T * T                          84..91    P: p * p, D_ref * D_ref
//            9..41     R: r                                     92..124   R: rho
//            42..79    D: cosine, sine, 1 / r, lambda's low,    85..124   P: to;  D: lambda_foot
//                      and step                                 125..158  D: 1 / rho
//            2..78     P, D: weight and line, beside            92..125   P: xf, zf; 16 products; L0, L1, Q0, Q1 of
//            both
//                                                               159       hand over
//
// Without a gap (`foot`) it takes the same time; a ray too far away ends behind lambda_foot.

#include "engine/model/blocks/prototype/vertical_compensation.hpp"
#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>

namespace rs::engine::model {

class ColumnSetupStage final : public SerialStage<LinedRay, ColumnSetup> {
public:
    static constexpr int kNoRayLatency = 2;
    static constexpr int kTooFarLatency = 1 + (kProductCycles + 2) + kRootCycles + kDivideCycles + 3 + kProductCycles +
                                          2 + kDivideCycles + kProductCycles;
    static constexpr int kShapeLatency = 1 + (kProductCycles + 2) + kRootCycles + kDivideCycles + 2 + kProductCycles +
                                         1 + (kProductCycles + 3) + kRootCycles + kDivideCycles + 1;

    ColumnSetupStage(const RegisterFile& registers, Fifo<LinedRay>& in, Fifo<ColumnSetup>& out);

private:
    int work(const LinedRay& in, ColumnSetup& out) override;
    const RegisterFile& registers_;
};

// The arithmetic without the clock, of a ray of an object with a shape map. False: the ray is too far away.
bool set_up_shape_column(const BoardView& view, const ObjectRegisters& object, const LinedRay& in, ColumnSetup& out);

// The columns of the two stripes under way: a memory of 32 places inside of a block. A member of blocks, not a block.

class ColumnTable {
public:
    ColumnTable() {
        for (ColumnSetup& setup : places_) setup.stripe = -1;
    }
    // With the first column of a stripe what is left of the one before in its place is forgotten (valid bits), for that
    // one may have been wider.
    void put(const ColumnSetup& setup) {
        if (setup.column == 0) {
            for (int n = 1; n < kStripeColumns; ++n) places_[place(setup.stripe, n)].stripe = -1;
        }
        places_[place(setup.stripe, setup.column)] = setup;
    }
    [[nodiscard]] const ColumnSetup& of(const ScannedPixel& pixel) const {
        return places_[place(pixel.stripe, pixel.column())];
    }
    // Its column has come.
    [[nodiscard]] bool holds(const ScannedPixel& pixel) const { return of(pixel).stripe == pixel.stripe; }

    static std::size_t place(int stripe, int column) {
        return static_cast<std::size_t>(stripe % kStripeSlots * kStripeColumns + column);
    }

private:
    std::array<ColumnSetup, std::size_t{kStripeSlots} * kStripeColumns> places_{};
};

}  // namespace rs::engine::model
