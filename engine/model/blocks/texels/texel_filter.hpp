#pragma once
// Texel filter: the sums of a sample over its four texels (RECONSTRUCTION.md, section 7): weight * alpha, and that
// times R, G and B: four small products, twelve of 14 x 8 bits, two levels of additions. A sample per cycle.

#include "engine/model/blocks/shared/delay_line.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/parallel_messages.hpp"

namespace rs::engine::model {

// The arithmetic without the clock.
FilteredSample filtered(const TexelQuad& quad);

class TexelFilter final : public Block {
public:
    static constexpr int kStages = 6;
    TexelFilter(Fifo<TexelQuad>& in, Fifo<FilteredSample>& out);
    Activity tick(std::uint64_t now) override;

private:
    Fifo<TexelQuad>& in_;
    Fifo<FilteredSample>& out_;
    DelayLine<FilteredSample> line_{kStages};
};

}  // namespace rs::engine::model
