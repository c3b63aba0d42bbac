#pragma once
// Pixel resolve (RECONSTRUCTION.md, section 8, "The output"): from the sums of a layer to R, G, B and alpha. Three
// pipelined dividers of 8 quotient bits (a 31-bit subtract and a choice each); a pixel per cycle.

#include "engine/model/blocks/delay_line.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/parallel_messages.hpp"

namespace rs::engine::model {

// The arithmetic without the clock; R in the low byte.
std::uint32_t resolved(const ChosenPixel& pixel);

class PixelResolve final : public Block {
public:
    static constexpr int kStages = 10;
    PixelResolve(Fifo<ChosenPixel>& in, Fifo<FinishedPixel>& out);
    Activity tick(std::uint64_t now) override;

private:
    Fifo<ChosenPixel>& in_;
    Fifo<FinishedPixel>& out_;
    DelayLine<FinishedPixel> line_{kStages};
};

}  // namespace rs::engine::model
