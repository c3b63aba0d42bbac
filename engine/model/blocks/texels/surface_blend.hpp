#pragma once
// Surface blend (RECONSTRUCTION.md, section 8): collects the one or two samples of a hit surface, blends them, and
// resolves the sums to R, G, B and alpha. If the surface is transparent there, the pixel returns to cell_march, or is
// empty after its last surface. A pixel that its last surface does not fully cover also returns if other surfaces are
// behind it; its colour is stored here and composited over the next surface that covers the pixel. A sample per cycle.
// Four products, then three pipelined dividers of 8 quotient bits (a 31-bit subtract and a selection each), then eight
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
    struct Ports {
        Fifo<FilteredSample>& in;
        Fifo<FinishedPixel>& out;
        Fifo<ReturnedPixel>& again;
    };
    explicit SurfaceBlend(const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::uint64_t sent_back() const { return sent_back_; }

private:
    struct Outcome {
        bool sends_back = false;
        FinishedPixel pixel;
        ReturnedPixel again;
    };
    Outcome resolve_surface(const SampleHead& last);

    Fifo<FilteredSample>& in_;
    Fifo<FinishedPixel>& out_;
    Fifo<ReturnedPixel>& again_;
    std::array<SampleSum, 2> samples_{};   // samples of the current surface
    std::array<Rgba8, kPatchIds> kept_{};  // colours of returned pixels; alpha 0: none
    DelayLine<Outcome> line_{kStages};
    std::uint64_t sent_back_ = 0;
};

}  // namespace rs::engine::model
