#pragma once
// YUV -> RGB (RECONSTRUCTION.md, section 4), a pixel per cycle through four stages: the four products by constants from
// tables in embedded RAM, two stages of 26-bit additions, clamp.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"

#include <array>

namespace rs::engine::model {

// The arithmetic without the clock.
std::uint32_t converted(const YuvaPixel& pixel);

class ColourConversion final : public Block {
public:
    static constexpr int kStages = 4;
    ColourConversion(Fifo<YuvaPixel>& in, Fifo<RgbaPixel>& out);
    Activity tick(std::uint64_t now) override;

private:
    struct Stage {
        bool full = false;
        RgbaPixel pixel;
    };
    Fifo<YuvaPixel>& in_;
    Fifo<RgbaPixel>& out_;
    std::array<Stage, kStages> stages_;
};

}  // namespace rs::engine::model
