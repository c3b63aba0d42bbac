#include "engine/model/blocks/pixel_resolve.hpp"

#include "engine/core/shape_pixel.hpp"

namespace rs::engine::model {

std::uint32_t resolved(const ChosenPixel& pixel) {
    const Rgba8 c = resolve({true, pixel.a, pixel.r, pixel.g, pixel.b});
    return static_cast<std::uint32_t>(c.r) | static_cast<std::uint32_t>(c.g) << 8U |
           static_cast<std::uint32_t>(c.b) << 16U | static_cast<std::uint32_t>(c.a) << 24U;
}

PixelResolve::PixelResolve(Fifo<ChosenPixel>& in, Fifo<FinishedPixel>& out)
    : Block("pixel_resolve", "latency " + std::to_string(kStages + 1) + ", a pixel per cycle"),
      in_(reads(in)),
      out_(writes(out)) {}

Activity PixelResolve::tick(std::uint64_t) {
    if (line_.leaves() && !out_.can_push()) return Activity::output_full;
    if (line_.leaves()) out_.push(line_.leaving());
    if (!in_.can_pop()) {
        line_.advance();
        return Activity::idle;
    }
    const ChosenPixel pixel = in_.pop();
    line_.advance(FinishedPixel{pixel.id, resolved(pixel)});
    return Activity::busy;
}

}  // namespace rs::engine::model
