#pragma once
// Vertical compensation: column of the captured image, first row and rows per view row (RECONSTRUCTION.md, section 3;
// the paper's eq. 2).
//
//     cycle  1       take the ray                       multiplier 2..10   x * l1
//            11      l = l0 + ..; l too small?                     12..20  x * q1
//            12..45  divider: m = fl_y / l                         22..30  lambda * S
//            21      q0 + ..                                       31..39  lambda * sy
//            22..55  divider: column                               46..54  m * (Y - height)
//            56      cx + ..; column, m, rise in range?            55..63  m * rise
//                                                       64 the signs;  65 output

#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

// Computes the walk, without the clock; returns its latency in cycles.
int compensate_column(const RegisterFile& registers, const RayLine& in, ColumnWalk& out);

class VerticalCompensation final : public SerialStage<RayLine, ColumnWalk> {
public:
    static constexpr int kNoRayLatency = 2;
    static constexpr int kTooNearLatency = 1 + kMultiplyCycles + 1 + 1;
    static constexpr int kOutsideLatency = kTooNearLatency + kMultiplyCycles + 1 + kDivideCycles + 1;
    static constexpr int kLatency = kOutsideLatency + 8;

    VerticalCompensation(const RegisterFile& registers, const Ports& ports);

private:
    int work(const RayLine& in, ColumnWalk& out) override { return compensate_column(registers_, in, out); }
    const RegisterFile& registers_;
};

}  // namespace rs::engine::model
