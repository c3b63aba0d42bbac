#include "engine/model/blocks/prototype/vertical_compensation.hpp"

namespace rs::engine::model {

VerticalCompensation::VerticalCompensation(const RegisterFile& registers, const Ports& ports)
    : SerialStage("vertical_compensation",
                  "latency and interval " + std::to_string(kLatency) + " (" + std::to_string(kOutsideLatency) +
                      " outside of the image, " + std::to_string(kTooNearLatency) + " too near, " +
                      std::to_string(kNoRayLatency) + " without a ray)",
                  ports),
      registers_(registers) {}

int compensate_column(const RegisterFile& registers, const RayLine& in, ColumnWalk& out) {
    using Timing = VerticalCompensation;
    constexpr std::int64_t kNearest_q20 = std::int64_t{1} << 17;
    constexpr std::int64_t kLargestRowScale_q16 = std::int64_t{1} << 30;
    constexpr std::int64_t kLargestRise_q24 = std::int64_t{1} << 28;
    out = {};
    out.view = in.view;
    if (!in.has_ray) return Timing::kNoRayLatency;
    const BoardView& view = registers.view(in.view);
    const std::int64_t l_q20 = in.l0_q20 + ((in.x_q20 * in.l1_q30) >> 30);
    if (l_q20 < kNearest_q20) return Timing::kTooNearLatency;

    const std::int64_t lateral_q16 = in.q0_q16 + ((in.x_q20 * in.q1_q16) >> 20);
    const Quotient offset_q16 = divide(lateral_q16 * (std::int64_t{1} << 20), l_q20);
    const Quotient m_q16 = divide(std::int64_t{in.fl_y_q16} << 20, l_q20);
    const std::int64_t rise_q24 = (in.lambda_q20 * view.sy_q32) >> 28;
    // A quotient of 2^32 or more is 2^16 columns beside the principal point, which is within 2^14 of the image.
    if (offset_q16.overflow || m_q16.overflow || m_q16.value >= kLargestRowScale_q16) return Timing::kOutsideLatency;
    const std::int64_t column = (in.cx_q16 + offset_q16.value) >> 16;
    if (column < 0 || column >= registers.object_of(in.view).width) return Timing::kOutsideLatency;
    if (rise_q24 < -kLargestRise_q24 || rise_q24 > kLargestRise_q24) return Timing::kOutsideLatency;

    const std::int64_t height_q20 = view.b_q20 + ((in.lambda_q20 * (view.s0_q32 >> 4)) >> 28);
    out.has_ray = true;
    out.image = in.image;
    out.column = static_cast<int>(column);
    out.row_0_q16 = in.cy_q16 - ((m_q16.value * (height_q20 - in.height_q20)) >> 20);
    out.row_step_q16 = -((m_q16.value * rise_q24) >> 24);
    return Timing::kLatency;
}

}  // namespace rs::engine::model
