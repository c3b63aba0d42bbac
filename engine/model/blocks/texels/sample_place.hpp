#pragma once
// Sample place: computes the samples of a hit surface in the two images, and the texels of each sample
// (RECONSTRUCTION.md, section 7 up to the four texels; section 3 for a ray without a shape map). A sample per cycle, at
// most two per surface; one token for a surface without samples. In sequence: lambda, height (a product each); in
// parallel l, the pipelined divider (1 / l), column and rows per radius, row; texel positions.

#include "engine/model/blocks/parallel/column_setup.hpp"
#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>

namespace rs::engine::model {

// Samples of a surface in order, without the clock; at least one token.
struct SurfaceSamples {
    int count = 0;
    std::array<PlacedSample, 2> sample;
};
SurfaceSamples place_samples(const SurfaceHit& met, const ColumnSetup& column, const ObjectRegisters& object,
                             std::int32_t b_q20);

class SamplePlace final : public Block {
public:
    static constexpr int kStages = 1 + kProductCycles + kDivideCycles + 2 * kProductCycles + 2;
    struct Ports {
        Fifo<ColumnSetup>& columns;
        Fifo<SurfaceHit>& in;
        Fifo<PlacedSample>& out;
    };
    SamplePlace(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;

private:
    const RegisterFile& registers_;
    Fifo<ColumnSetup>& columns_;
    Fifo<SurfaceHit>& in_;
    ColumnTable table_;
    SurfaceSamples surface_;  // samples of the surface at the front of in_, if some have been taken
    int taken_ = 0;
    PipelinedStage<PlacedSample> stage_;
};

}  // namespace rs::engine::model
