#pragma once
// Horizontal raster generator: the columns of a view, and the reference plane of each (RECONSTRUCTION.md, section 2, up
// to k, n and T).
//
// Two accumulators per plane (36 bits, in embedded RAM) hold N and T of the column. Each cycle one plane is read,
// compared with the smallest N so far, incremented by its change per column and written back: one 36-bit adder for each
// of N and T, one comparator. K cycles for K planes, and one to output the column.

#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/messages.hpp"
#include "engine/model/signals/registers.hpp"
#include "engine/model/signals/stripes.hpp"

#include <array>

namespace rs::engine::model {

class RasterGenerator final : public Block {
public:
    // Outputs the columns of `share` and skips the others: the accumulators need the increments of every column.
    struct Ports {
        Fifo<ViewJob>& jobs;
        Fifo<ColumnRay>& columns;
    };
    RasterGenerator(const RegisterFile& registers, const StripeShare& share, const Ports& ports);
    Activity tick(std::uint64_t now) override;

private:
    const RegisterFile& registers_;
    StripeShare share_;
    Fifo<ViewJob>& jobs_;
    Fifo<ColumnRay>& columns_;
    bool active_ = false;
    int view_ = 0;
    int column_ = 0;
    int plane_ = 0;  // K: output
    std::array<std::int64_t, kMaxPlanes> n_q32_{};
    std::array<std::int64_t, kMaxPlanes> t_q32_{};
    ColumnRay best_;
    std::int64_t smallest_q28_ = 0;
};

// Ray position: computes from a column's direction the point (x, u) on the reference plane (the paper's eq. 1), the
// axial distance, and the cell of the RS map (RECONSTRUCTION.md, section 2, from u on).
//
//     cycle  1       take the column                     45      x = a + u c; ranges of x and lambda
//            2..35   divider: u  (and lambda, a later)   46..54  (x + x_half) * x_cells_per_unit
//            2..10   multiplier: k * x_cells             55..63  (u + u_half) * u_cells_per_unit
//            36..44  multiplier: u * c                   64      clamp xi, ui
//                                                        65..73  (k * x_cells + xi) * u_cells
//                                                        74      + ui + the map's address;  75  output

class RayPosition final : public SerialStage<ColumnRay, RayPoint> {
public:
    static constexpr int kNoRayLatency = 2;
    static constexpr int kMissLatency = 1 + kDivideCycles + kMultiplyCycles + 1 + 1;
    static constexpr int kLatency = kMissLatency + 3 * kMultiplyCycles + 2;

    RayPosition(const RegisterFile& registers, const Ports& ports);

private:
    int work(const ColumnRay& in, RayPoint& out) override;
    const RegisterFile& registers_;
};

}  // namespace rs::engine::model
