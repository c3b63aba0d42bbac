#pragma once
// Column set-up: computes all values shared by the pixels of a column. Without a shape map the walk of
// vertical_compensation, with its latency; with a shape map section 5 of RECONSTRUCTION.md, with one pipelined
// multiplier (P, a product per cycle), one pipelined divider (D) and one unit for square roots (R):
//
//     cycle  1         take the ray                             78..83    P: p = x * cosine
//            2..8      P: n * n, T * T                          84..91    P: p * p, D_ref * D_ref
//            9..41     R: r                                     92..124   R: rho
//            42..79    D: cosine, sine, 1 / r, lambda's low,    85..124   P: to;  D: lambda_foot
//                      and step                                 125..158  D: 1 / rho
//            2..78     P, D: weight and line, in parallel       92..125   P: xf, zf; 16 products; L0, L1, Q0, Q1
//                                                                         of both
//                                                               159       output
//
// Without a gap (`foot`) the latency is the same; a ray too far away ends after lambda_foot.

#include "engine/model/blocks/prototype/vertical_compensation.hpp"
#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>

namespace rs::engine::model {

class ColumnSetupStage final : public SerialStage<RayWithLines, ColumnSetup> {
public:
    static constexpr int kNoRayLatency = 2;
    static constexpr int kTooFarLatency = 1 + (kProductCycles + 2) + kRootCycles + kDivideCycles + 3 + kProductCycles +
                                          2 + kDivideCycles + kProductCycles;
    static constexpr int kShapeLatency = 1 + (kProductCycles + 2) + kRootCycles + kDivideCycles + 2 + kProductCycles +
                                         1 + (kProductCycles + 3) + kRootCycles + kDivideCycles + 1;

    ColumnSetupStage(const RegisterFile& registers, const Ports& ports);

private:
    int work(const RayWithLines& in, ColumnSetup& out) override;
    const RegisterFile& registers_;
};

// Set-up of a ray of an object with a shape map, without the clock. Returns false if the ray is too far away.
bool set_up_shape_column(const BoardView& view, const ObjectRegisters& object, const RayWithLines& in,
                         ColumnSetup& out);

// Columns of the two stripes in flight: a memory of 32 entries. A member of blocks, not a block.

class ColumnTable {
public:
    ColumnTable() {
        for (ColumnSetup& setup : places_) setup.stripe = -1;
    }
    // The first column of a stripe invalidates all columns of the previous stripe in the same place (valid bits), which
    // may have been wider.
    void put(const ColumnSetup& setup) {
        if (setup.column == 0) {
            for (int n = 1; n < kStripeColumns; ++n) places_[place(setup.stripe, n)].stripe = -1;
        }
        places_[place(setup.stripe, setup.column)] = setup;
    }
    [[nodiscard]] const ColumnSetup& of(const ScannedPixel& pixel) const {
        return places_[place(pixel.stripe, pixel.column())];
    }
    // True if the column of the pixel has been stored.
    [[nodiscard]] bool holds(const ScannedPixel& pixel) const { return of(pixel).stripe == pixel.stripe; }

    static std::size_t place(int stripe, int column) {
        return static_cast<std::size_t>(stripe % kStripeSlots * kStripeColumns + column);
    }

private:
    std::array<ColumnSetup, std::size_t{kStripeSlots} * kStripeColumns> places_{};
};

}  // namespace rs::engine::model
