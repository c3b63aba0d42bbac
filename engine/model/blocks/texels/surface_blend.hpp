#pragma once
// Surface blend (RECONSTRUCTION.md, section 8): collects the one or two samples of a met surface, blends them, and
// makes of the sums R, G, B and alpha. Where the surface shows nothing the pixel goes back to cell_march, or, behind
// its last surface, is empty. A pixel that the last surface does not cover goes back as well, where others lie behind
// it, and what it shows is kept here until one comes that covers the pixel, over which it is laid. A sample per cycle.
// Four products, then three pipelined dividers of 8 quotient bits (a 31-bit subtract and a choice each), then eight
// products of 8 x 9 bits.

#include "engine/core/definition/shape_pixel.hpp"
#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/parallel_messages.hpp"

#include <array>

namespace rs::engine::model {

class SurfaceBlend final : public Block {
public:
    static constexpr int kBlendStages = 4;
    static constexpr int kResolveStages = 10;
    static constexpr int kOverStages = 2;
    static constexpr int kStages = kBlendStages + kResolveStages + kOverStages;
    static constexpr std::size_t kKeptBits = std::size_t{kPatchIds} * 32;
    SurfaceBlend(Fifo<FilteredSample>& in, Fifo<FinishedPixel>& out, Fifo<MarchAgain>& again);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::uint64_t sent_back() const { return sent_back_; }

private:
    struct Outcome {
        bool sends_back = false;
        FinishedPixel pixel;
        MarchAgain again;
    };
    Outcome decided(const SampleHead& last);

    Fifo<FilteredSample>& in_;
    Fifo<FinishedPixel>& out_;
    Fifo<MarchAgain>& again_;
    std::array<SampleSum, 2> samples_{};   // of the surface, so far
    std::array<Rgba8, kPatchIds> kept_{};  // of pixels that were sent back; alpha 0 where there is nothing
    DelayLine<Outcome> line_{kStages};
    std::uint64_t sent_back_ = 0;
};

}  // namespace rs::engine::model
