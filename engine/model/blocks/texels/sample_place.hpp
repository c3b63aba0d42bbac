#pragma once
// Sample place: of a met surface its samples in the two images, and of a sample the texels that it takes
// (RECONSTRUCTION.md, section 7 to the four texels; section 3 for a ray without a shape map). A sample per cycle, up to
// two of a surface, one token of a surface without any. Behind one another: lambda, height (a product each); beside
// them l, the pipelined divider (1 / l), column and rows per radius, row; place of the texels.

#include "engine/model/blocks/parallel/column_setup.hpp"
#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

#include <array>

namespace rs::engine::model {

// The arithmetic without the clock: the samples of a surface, in order; at least one token.
struct SurfaceSamples {
    int count = 0;
    std::array<PlacedSample, 2> sample;
};
SurfaceSamples placed_samples(const MetSurface& met, const ColumnSetup& column, const ObjectRegisters& object,
                              std::int32_t b_q20);

class SamplePlace final : public Block {
public:
    static constexpr int kStages = 1 + kProductCycles + kDivideCycles + 2 * kProductCycles + 2;
    SamplePlace(const RegisterFile& registers, Fifo<ColumnSetup>& columns, Fifo<MetSurface>& in,
                Fifo<PlacedSample>& out);
    Activity tick(std::uint64_t now) override;

private:
    const RegisterFile& registers_;
    Fifo<ColumnSetup>& columns_;
    Fifo<MetSurface>& in_;
    ColumnTable table_;
    SurfaceSamples surface_;  // that of in_'s front, where some of its samples have been taken
    int taken_ = 0;
    PipelinedStage<PlacedSample> stage_;
};

}  // namespace rs::engine::model
