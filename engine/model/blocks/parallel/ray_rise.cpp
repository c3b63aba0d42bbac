#include "engine/model/blocks/parallel/ray_rise.hpp"

#include "engine/core/definition/fixed_point.hpp"

namespace rs::engine::model {

RisenPixel risen(const ScannedPixel& pixel, const ColumnSetup& column, const ShapeRegisters& shape,
                 std::int32_t b_q20) {
    constexpr std::int32_t kMostPerDepth_q20 = 1 << 22;
    RisenPixel out;
    out.pixel = pixel;
    if (column.kind != RayKind::shape) return out;
    const auto narrow = [](std::int64_t v) { return static_cast<std::int32_t>(v); };
    const std::int32_t h_q16 = (b_q20 >> 4) + multiply_shift(narrow(column.lambda_foot_q20), pixel.rise_q24, 28);
    const std::int32_t slope_q20 = multiply_shift(pixel.rise_q24, narrow(column.inverse_r_q20), 24);
    const std::int32_t reference_q20 =
        multiply_shift(h_q16 - (shape.reference_height_q20 >> 4), narrow(column.inverse_rho_q20), 16);
    const std::int32_t drift_q20 = multiply_shift(slope_q20 - reference_q20, shape.bands_per_unit_q12, 12);
    out.foot_q12 = multiply_shift(h_q16 - (shape.h_low_q20 >> 4), shape.bands_per_unit_q12, 16);
    out.zero_q12 = out.foot_q12 + multiply_shift(drift_q20, shape.depth_low_q20, 28);
    out.per_d_q20 =
        std::clamp(multiply_shift(drift_q20, shape.depth_step_q24, 24), -kMostPerDepth_q20, kMostPerDepth_q20);
    return out;
}

RayRise::RayRise(const RegisterFile& registers, Fifo<ColumnSetup>& columns, Fifo<ScannedPixel>& in,
                 Fifo<RisenPixel>& out)
    : Block("ray_rise", "latency " + std::to_string(kStages + 1) + ", a pixel per cycle"),
      registers_(registers),
      columns_(reads(columns)),
      in_(reads(in)),
      out_(writes(out)) {}

Activity RayRise::tick(std::uint64_t) {
    const bool takes_column = columns_.can_pop();
    if (takes_column) table_.put(columns_.pop());
    if (line_.leaves() && !out_.can_push()) return takes_column ? Activity::busy : Activity::output_full;
    if (line_.leaves()) out_.push(line_.leaving());
    if (!in_.can_pop() || takes_column || !table_.holds(in_.front())) {  // the table has one port
        line_.advance();
        return takes_column ? Activity::busy : Activity::idle;
    }
    const ScannedPixel pixel = in_.pop();
    line_.advance(
        risen(pixel, table_.of(pixel), registers_.object_of(pixel.view).shape, registers_.view(pixel.view).b_q20));
    return Activity::busy;
}

}  // namespace rs::engine::model
