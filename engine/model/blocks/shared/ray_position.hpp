#pragma once
// Ray position: from a column's direction to the point (x, u) on the reference plane (the paper's eq. 1), the axial
// distance, and the cell of the RS map (RECONSTRUCTION.md, section 2, from u on).
//
//     cycle  1       take the column                     45      x = a + u c; ranges of x and lambda
//            2..35   divider: u  (and lambda, a later)   46..54  (x + x_half) * x_cells_per_unit
//            2..10   multiplier: k * x_cells             55..63  (u + u_half) * u_cells_per_unit
//            36..44  multiplier: u * c                   64      clamp xi, ui
//                                                        65..73  (k * x_cells + xi) * u_cells
//                                                        74      + ui + the map's address;  75  hand over

#include "engine/model/blocks/shared/serial_stage.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

class RayPosition final : public SerialStage<ColumnRay, RayPoint> {
public:
    static constexpr int kNoRayLatency = 2;
    static constexpr int kMissLatency = 1 + kDivideCycles + kMultiplyCycles + 1 + 1;
    static constexpr int kLatency = kMissLatency + 3 * kMultiplyCycles + 2;

    RayPosition(const RegisterFile& registers, Fifo<ColumnRay>& in, Fifo<RayPoint>& out);

private:
    int work(const ColumnRay& in, RayPoint& out) override;
    const RegisterFile& registers_;
};

}  // namespace rs::engine::model
