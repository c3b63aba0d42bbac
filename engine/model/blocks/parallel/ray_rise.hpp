#pragma once
// Ray rise: at which bands a pixel's ray begins and how it passes through them (RECONSTRUCTION.md, section 6, to
// per_d). Seven multipliers in five steps one behind the other; a pixel per cycle. A pixel waits for its column.

#include "engine/model/blocks/parallel/column_table.hpp"
#include "engine/model/blocks/shared/delay_line.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "engine/model/signals/parallel_messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

// The arithmetic without the clock.
RisenPixel risen(const ScannedPixel& pixel, const ColumnSetup& column, const ShapeRegisters& shape, std::int32_t b_q20);

class RayRise final : public Block {
public:
    static constexpr int kStages = 5 * kProductCycles;
    RayRise(const RegisterFile& registers, Fifo<ColumnSetup>& columns, Fifo<ScannedPixel>& in, Fifo<RisenPixel>& out);
    Activity tick(std::uint64_t now) override;

private:
    const RegisterFile& registers_;
    Fifo<ColumnSetup>& columns_;
    Fifo<ScannedPixel>& in_;
    Fifo<RisenPixel>& out_;
    ColumnTable table_;
    DelayLine<RisenPixel> line_{kStages};
};

}  // namespace rs::engine::model
