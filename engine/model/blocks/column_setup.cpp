#include "engine/model/blocks/column_setup.hpp"

#include <algorithm>

namespace rs::engine::model {
namespace {

// A ray of a vertical plane: through its foot (x, z), in direction (sine, -cosine) along (tangent, normal).
struct PlaneRay {
    std::int64_t cosine_q30 = 0, sine_q30 = 0;
    std::int64_t foot_x_q20 = 0, foot_z_q20 = 0;
    std::int64_t low_q20 = 0, step_q24 = 0;
};

PictureSetup along_ray(const PlaneRay& ray, int picture, const PictureLine& line) {
    constexpr std::int64_t kMostPerStep = std::int64_t{1} << 22;
    const std::int64_t l_foot_q20 = line.l0_q20 + ((ray.foot_x_q20 * line.l1_q30 + ray.foot_z_q20 * line.l2_q30) >> 30);
    const std::int64_t l_along_q30 = (ray.sine_q30 * line.l1_q30 - ray.cosine_q30 * line.l2_q30) >> 30;
    const std::int64_t q_foot_q16 = line.q0_q16 + ((ray.foot_x_q20 * line.q1_q16 + ray.foot_z_q20 * line.q2_q16) >> 20);
    const std::int64_t q_along_q16 = (ray.sine_q30 * line.q1_q16 - ray.cosine_q30 * line.q2_q16) >> 30;
    PictureSetup setup;
    setup.picture = picture;
    setup.l0_q20 = l_foot_q20 + ((ray.low_q20 * l_along_q30) >> 30);
    setup.l1_q24 = (ray.step_q24 * l_along_q30) >> 30;
    setup.q0_q12 = (q_foot_q16 + ((ray.low_q20 * q_along_q16) >> 20)) >> 4;
    setup.q1_q14 = std::clamp((ray.step_q24 * q_along_q16) >> 26, -kMostPerStep, kMostPerStep);
    setup.cx_q16 = line.cx_q16;
    setup.cy_q16 = line.cy_q16;
    setup.fl_y_q16 = line.fl_y_q16;
    setup.height_q20 = line.height_q20;
    return setup;
}

}  // namespace

bool set_up_shape_column(const BoardView& view, const ObjectRegisters& object, const LinedRay& in, ColumnSetup& out) {
    constexpr std::int64_t kFarthest_q20 = std::int64_t{1} << 29;
    const BracketedRay& ray = in.ray;
    const ShapeRegisters& shape = object.shape;
    const PlaneView& plane = view.planes[static_cast<std::size_t>(ray.plane)];
    const std::int64_t r_q28 =
        square_root_serially(static_cast<std::uint64_t>(ray.n_q28 * ray.n_q28 + ray.t_q28 * ray.t_q28));
    PlaneRay along;
    along.cosine_q30 = divide(ray.n_q28 * (std::int64_t{1} << 30), r_q28).value;
    along.sine_q30 = divide(ray.t_q28 * (std::int64_t{1} << 30), r_q28).value;
    const std::int64_t p_q20 = (ray.x_q20 * along.cosine_q30) >> 30;
    const std::int64_t to_q20 = (plane.c_q20 * along.cosine_q30 - plane.a_q20 * along.sine_q30) >> 30;
    const Quotient lambda_foot_q20 = divide(to_q20 * (std::int64_t{1} << 28), r_q28);
    if (lambda_foot_q20.overflow || lambda_foot_q20.value <= -kFarthest_q20 || lambda_foot_q20.value >= kFarthest_q20) {
        return false;
    }
    out.kind = ray.kind;
    out.lambda_foot_q20 = lambda_foot_q20.value;
    out.inverse_r_q20 = divide(std::int64_t{1} << 48, r_q28).value;
    const std::int64_t d_q20 = shape.reference_distance_q20;
    const std::int64_t rho_q20 =
        square_root_serially(static_cast<std::uint64_t>(std::max(d_q20 * d_q20 - p_q20 * p_q20, (d_q20 * d_q20) / 4)));
    out.inverse_rho_q20 = divide(std::int64_t{1} << 40, rho_q20).value;

    along.foot_x_q20 = (p_q20 * along.cosine_q30) >> 30;
    along.foot_z_q20 = (p_q20 * along.sine_q30) >> 30;
    if (ray.kind == RayKind::shape) {
        along.low_q20 = shape.depth_low_q20;
        along.step_q24 = shape.depth_step_q24;
        const std::int64_t f = ray.from_first_q20;
        const std::int64_t w = ray.width_q20;
        out.weight = static_cast<int>(divide(512 * f + w, 2 * w).value);
        out.map_line = ray.first_line + divide(f * ray.lines, w).value;
        out.map_place = static_cast<int>(std::clamp<std::int64_t>(
            ((p_q20 + shape.p_half_q20) * shape.p_cells_per_unit_q12) >> 32, 0, shape.p_cells - 1));
        out.pictures[1] = along_ray(along, ray.second, in.picture[1]);
    }
    out.pictures[0] = along_ray(along, ray.first, in.picture[0]);
    out.lambda0_q20 = out.lambda_foot_q20 + divide(along.low_q20 * (std::int64_t{1} << 28), r_q28).value;
    out.lambda1_q24 = divide(along.step_q24 << 28, r_q28).value;
    return true;
}

ColumnSetupStage::ColumnSetupStage(const RegisterFile& registers, Fifo<LinedRay>& in, Fifo<ColumnSetup>& out)
    : SerialStage("column_setup",
                  "latency and interval " + std::to_string(kShapeLatency) + " (" + std::to_string(kTooFarLatency) +
                      " too far; without a shape map " + std::to_string(VerticalCompensation::kLatency) + ", " +
                      std::to_string(VerticalCompensation::kOutsideLatency) + " outside of the picture, " +
                      std::to_string(VerticalCompensation::kTooNearLatency) + " too near; " +
                      std::to_string(kNoRayLatency) + " without a ray)",
                  in, out),
      registers_(registers) {}

int ColumnSetupStage::work(const LinedRay& in, ColumnSetup& out) {
    out = {};
    out.view = in.ray.view;
    if (in.ray.kind == RayKind::none) return kNoRayLatency;
    if (in.ray.kind != RayKind::plane) {
        const bool near = set_up_shape_column(registers_.view(in.ray.view), registers_.object_of(in.ray.view), in, out);
        return near ? kShapeLatency : kTooFarLatency;
    }
    const PictureLine& p = in.picture[0];
    ColumnWalk walk;
    const int latency = compensated(registers_,
                                    {in.ray.view, true, in.ray.x_q20, in.ray.lambda_q20, in.ray.first, p.cx_q16,
                                     p.cy_q16, p.fl_y_q16, p.height_q20, p.l0_q20, p.l1_q30, p.q0_q16, p.q1_q16},
                                    walk);
    if (!walk.has_ray) return latency;
    out.kind = RayKind::plane;
    out.picture = walk.picture;
    out.picture_column = walk.column;
    out.row_0_q16 = walk.row_0_q16;
    out.row_step_q16 = walk.row_step_q16;
    return latency;
}

}  // namespace rs::engine::model
