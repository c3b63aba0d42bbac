#include "engine/model/blocks/texels/texel_filter.hpp"

namespace rs::engine::model {

FilteredSample filtered(const TexelQuad& quad) {
    FilteredSample out{quad.head, quad.inside, 0, 0, 0, 0};
    if (!quad.inside) return out;
    const int weights[] = {(8 - quad.fx) * (8 - quad.fy), (8 - quad.fx) * quad.fy, quad.fx * (8 - quad.fy),
                           quad.fx * quad.fy};
    for (std::size_t n = 0; n < 4; ++n) {
        const auto byte = [&](unsigned at) { return static_cast<std::int32_t>((quad.rgba[n] >> (8 * at)) & 255U); };
        const std::int32_t share = weights[n] * byte(3);
        out.a += share;
        out.r += share * byte(0);
        out.g += share * byte(1);
        out.b += share * byte(2);
    }
    return out;
}

TexelFilter::TexelFilter(Fifo<TexelQuad>& in, Fifo<FilteredSample>& out)
    : Block("texel_filter", "latency " + std::to_string(kStages + 1) + ", a sample per cycle"),
      in_(reads(in)),
      out_(writes(out)) {}

Activity TexelFilter::tick(std::uint64_t) {
    if (line_.leaves() && !out_.can_push()) return Activity::output_full;
    if (line_.leaves()) out_.push(line_.leaving());
    if (!in_.can_pop()) {
        line_.advance();
        return Activity::idle;
    }
    line_.advance(filtered(in_.pop()));
    return Activity::busy;
}

}  // namespace rs::engine::model
