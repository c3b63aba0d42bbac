#include "engine/model/blocks/parallel/column_setup.hpp"

#include <algorithm>

namespace rs::engine::model {
namespace {

// A ray in a vertical plane: through its foot (x, z), in direction (sine, -cosine) along (tangent, normal).
struct PlaneRay {
    std::int64_t cosine_q30 = 0, sine_q30 = 0;
    std::int64_t foot_x_q20 = 0, foot_z_q20 = 0;
    std::int64_t low_q20 = 0, step_q24 = 0;
};

ImageSetup along_ray(const PlaneRay& ray, int image, const ImageLine& line) {
    constexpr std::int64_t kMostPerStep = std::int64_t{1} << 20;
    const std::int64_t l_foot_q20 = line.l0_q20 + ((ray.foot_x_q20 * line.l1_q30 + ray.foot_z_q20 * line.l2_q30) >> 30);
    const std::int64_t l_along_q30 = (ray.sine_q30 * line.l1_q30 - ray.cosine_q30 * line.l2_q30) >> 30;
    const std::int64_t q_foot_q16 = line.q0_q16 + ((ray.foot_x_q20 * line.q1_q16 + ray.foot_z_q20 * line.q2_q16) >> 20);
    const std::int64_t q_along_q16 = (ray.sine_q30 * line.q1_q16 - ray.cosine_q30 * line.q2_q16) >> 30;
    ImageSetup setup;
    setup.image = image;
    setup.l0_q20 = l_foot_q20 + ((ray.low_q20 * l_along_q30) >> 30);
    setup.l1_q24 = (ray.step_q24 * l_along_q30) >> 30;
    setup.q0_q12 = (q_foot_q16 + ((ray.low_q20 * q_along_q16) >> 20)) >> 4;
    setup.q1_q12 = std::clamp((ray.step_q24 * q_along_q16) >> 28, -kMostPerStep, kMostPerStep);
    setup.cx_q16 = line.cx_q16;
    setup.cy_q16 = line.cy_q16;
    setup.fl_y_q16 = line.fl_y_q16;
    setup.height_q20 = line.height_q20;
    return setup;
}

// Finds the columns of cells beside the ray, which is at line_q8 of its gap's lines and at p_q8 of the cells along p;
// samples are at cell centres. Lines of neighbouring gaps are consecutive; those of the first gap follow those of the
// last.
void find_cells(const ShapeRegisters& shape, const BracketedRay& ray, std::int64_t line_q8, std::int64_t p_q8,
                ColumnSetup& out) {
    const std::int64_t line = (line_q8 - 128) >> 8;
    const std::int64_t p = (p_q8 - 128) >> 8;
    out.line_part = static_cast<int>(((line_q8 - 128) >> 5) & 7);
    out.p_part = static_cast<int>(((p_q8 - 128) >> 5) & 7);
    const std::int64_t first = ray.lines_before ? -1 : 0;
    const std::int64_t last = ray.lines_behind ? ray.lines : ray.lines - 1;
    for (int n = 0; n < 2; ++n) {
        const auto at = static_cast<std::size_t>(n);
        std::int64_t number = ray.first_line + std::clamp<std::int64_t>(line + n, first, last);
        if (number < 0) number += shape.lines;
        if (number >= shape.lines) number -= shape.lines;
        out.map_line[at] = number;
        out.map_place[at] = static_cast<int>(std::clamp<std::int64_t>(p + n, 0, shape.p_cells - 1));
    }
}

}  // namespace

bool set_up_shape_column(const BoardView& view, const ObjectRegisters& object, const RayWithLines& in,
                         ColumnSetup& out) {
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
        find_cells(shape, ray, divide(f * (std::int64_t{256} * ray.lines), w).value,
                   ((p_q20 + shape.p_half_q20) * shape.p_cells_per_unit_q12) >> 24, out);
        out.images[1] = along_ray(along, ray.second, in.image[1]);
    }
    out.images[0] = along_ray(along, ray.first, in.image[0]);
    out.lambda0_q20 = out.lambda_foot_q20 + divide(along.low_q20 * (std::int64_t{1} << 28), r_q28).value;
    out.lambda1_q21 = divide(along.step_q24 << 25, r_q28).value;
    return true;
}

ColumnSetupStage::ColumnSetupStage(const RegisterFile& registers, const Ports& ports)
    : SerialStage("column_setup",
                  "latency and interval " + std::to_string(kShapeLatency) + " (" + std::to_string(kTooFarLatency) +
                      " too far; without a shape map " + std::to_string(VerticalCompensation::kLatency) + ", " +
                      std::to_string(VerticalCompensation::kOutsideLatency) + " outside of the image, " +
                      std::to_string(VerticalCompensation::kTooNearLatency) + " too near; " +
                      std::to_string(kNoRayLatency) + " without a ray)",
                  ports),
      registers_(registers) {}

int ColumnSetupStage::work(const RayWithLines& in, ColumnSetup& out) {
    out = {};
    out.view = in.ray.view;
    if (in.ray.kind == RayKind::none) return kNoRayLatency;
    if (in.ray.kind != RayKind::plane) {
        const bool near = set_up_shape_column(registers_.view(in.ray.view), registers_.object_of(in.ray.view), in, out);
        return near ? kShapeLatency : kTooFarLatency;
    }
    const ImageLine& p = in.image[0];
    ColumnWalk walk;
    const int latency = compensate_column(registers_,
                                          {in.ray.view, true, in.ray.x_q20, in.ray.lambda_q20, in.ray.first, p.cx_q16,
                                           p.cy_q16, p.fl_y_q16, p.height_q20, p.l0_q20, p.l1_q30, p.q0_q16, p.q1_q16},
                                          walk);
    if (!walk.has_ray) return latency;
    out.kind = RayKind::plane;
    out.image = walk.image;
    out.image_column = walk.column;
    out.row_0_q16 = walk.row_0_q16;
    out.row_step_q16 = walk.row_step_q16;
    return latency;
}

}  // namespace rs::engine::model
