#include "engine/model/blocks/shared/colour_conversion.hpp"

#include "rayspace/object/yuv.hpp"

namespace rs::engine::model {

std::uint32_t converted(const YuvaPixel& pixel) {
    const Rgba8 c = rgba_from_yuva(pixel.y, pixel.u, pixel.v, pixel.alpha);
    return static_cast<std::uint32_t>(c.r) | static_cast<std::uint32_t>(c.g) << 8U |
           static_cast<std::uint32_t>(c.b) << 16U | static_cast<std::uint32_t>(c.a) << 24U;
}

ColourConversion::ColourConversion(Fifo<YuvaPixel>& in, Fifo<RgbaPixel>& out)
    : Block("colour_conversion", "latency " + std::to_string(kStages + 1) + ", a pixel per cycle"),
      in_(reads(in)),
      out_(writes(out)) {}

Activity ColourConversion::tick(std::uint64_t) {
    if (stages_.back().full && !out_.can_push()) return Activity::output_full;  // the whole pipe stands
    bool full = false;
    for (const Stage& stage : stages_) full |= stage.full;
    if (!full && !in_.can_pop()) return Activity::idle;
    if (stages_.back().full) out_.push(stages_.back().pixel);
    for (std::size_t n = stages_.size() - 1; n > 0; --n) stages_[n] = stages_[n - 1];
    stages_[0].full = in_.can_pop();
    if (stages_[0].full) {
        const YuvaPixel pixel = in_.pop();
        stages_[0].pixel = {pixel.view, converted(pixel)};
    }
    return stages_[0].full ? Activity::busy : Activity::idle;  // idle: pixels leave, none comes
}

}  // namespace rs::engine::model
