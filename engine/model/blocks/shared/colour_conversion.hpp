#pragma once
// YUV -> RGB (RECONSTRUCTION.md, section 4), a pixel per cycle through four stages: the four products by constants from
// tables in embedded RAM, two stages of 26-bit additions, clamp.

#include "engine/model/blocks/shared/stages.hpp"
#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"

namespace rs::engine::model {

// RGBA of a pixel, R in the low byte, without the clock.
std::uint32_t convert_to_rgba(const YuvaPixel& pixel);

class ColourConversion final : public Block {
public:
    static constexpr int kStages = 4;
    struct Ports {
        Fifo<YuvaPixel>& in;
        Fifo<RgbaPixel>& out;
    };
    explicit ColourConversion(const Ports& ports);
    Activity tick(std::uint64_t now) override;

private:
    Fifo<YuvaPixel>& in_;
    PipelinedStage<RgbaPixel> stage_;
};

}  // namespace rs::engine::model
