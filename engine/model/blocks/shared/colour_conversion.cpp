#include "engine/model/blocks/shared/colour_conversion.hpp"

#include "rayspace/object/yuv.hpp"

namespace rs::engine::model {

std::uint32_t convert_to_rgba(const YuvaPixel& pixel) {
    const Rgba8 c = rgba_from_yuva(pixel.y, pixel.u, pixel.v, pixel.alpha);
    return static_cast<std::uint32_t>(c.r) | static_cast<std::uint32_t>(c.g) << 8U |
           static_cast<std::uint32_t>(c.b) << 16U | static_cast<std::uint32_t>(c.a) << 24U;
}

ColourConversion::ColourConversion(const Ports& ports)
    : Block("colour_conversion", "latency " + std::to_string(kStages + 1) + ", a pixel per cycle"),
      in_(reads(ports.in)),
      stage_(kStages, writes(ports.out)) {}

Activity ColourConversion::tick(std::uint64_t) {
    return stage_.step([&](std::optional<RgbaPixel>& out) {
        if (!in_.can_pop()) return Activity::idle;
        const YuvaPixel pixel = in_.pop();
        out = {pixel.view, convert_to_rgba(pixel)};
        return Activity::busy;
    });
}

}  // namespace rs::engine::model
