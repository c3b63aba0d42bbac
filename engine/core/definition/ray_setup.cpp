#include "engine/core/definition/ray_setup.hpp"

#include "engine/core/definition/fixed_point.hpp"

#include <algorithm>

namespace rs::engine {
namespace {

constexpr std::int64_t kMinNormalComponent_q28 = std::int64_t{1} << 24;
constexpr std::int64_t kMaxPlaneDepth_q20 = std::int64_t{1} << 29;

int clamped(std::int64_t cell, int cells) {
    return static_cast<int>(std::clamp<std::int64_t>(cell, 0, cells - 1));
}

}  // namespace

PlanePoint plane_point(const Ring& ring, const ViewRegisters& registers, int i, int j) {
    constexpr PlanePoint kNone;
    PlanePoint point;
    std::int64_t smallest = registers.planes[0].along_normal.at(i, j) >> 4;
    for (int candidate = 1; candidate < ring.planes; ++candidate) {
        const std::int64_t n = registers.planes[static_cast<std::size_t>(candidate)].along_normal.at(i, j) >> 4;
        if (n < smallest) {
            smallest = n;
            point.plane = candidate;
        }
    }
    const PlaneRegisters& plane = registers.planes[static_cast<std::size_t>(point.plane)];
    point.n_q28 = -smallest;
    if (plane.c_q20 <= 0 || point.n_q28 < kMinNormalComponent_q28) return kNone;
    point.t_q28 = plane.along_tangent.at(i, j) >> 4;
    const std::int64_t c_q20 = plane.c_q20;
    point.u_q28 = floor_divide(point.t_q28 * (std::int64_t{1} << 28), point.n_q28);
    point.x_q20 = plane.a_q20 + ((point.u_q28 * c_q20) >> 28);
    point.lambda_q20 = (c_q20 << 28) / point.n_q28;
    point.exists =
        point.x_q20 >= -ring.x_half_q20 && point.x_q20 < ring.x_half_q20 && point.lambda_q20 < kMaxPlaneDepth_q20;
    return point;
}

std::uint16_t look_up_rs_map(const Ring& ring, const PlanePoint& point) {
    const std::int64_t xi = ((point.x_q20 + ring.x_half_q20) * ring.x_cells_per_unit_q12) >> 32;
    const std::int64_t ui = ((point.u_q28 + ring.u_half_q28) * ring.u_cells_per_unit_q12) >> 40;
    return ring.cells[ring.cell_index(point.plane, clamped(xi, ring.x_cells), clamped(ui, ring.u_cells))];
}

namespace {

constexpr std::int64_t kOne_q20 = std::int64_t{1} << 20;
constexpr std::int64_t kMinDepth_q20 = std::int64_t{1} << 17;
constexpr std::int64_t kLargestRowScale_q16 = std::int64_t{1} << 30;
constexpr std::int64_t kLargestRise_q24 = std::int64_t{1} << 28;

}  // namespace

RaySetup set_up_ray(const RaySpaceObject& object, const ViewRegisters& registers, int i, int j) {
    constexpr RaySetup kNoRay;
    const Ring& ring = object.rings[static_cast<std::size_t>(registers.ring)];

    const PlanePoint point = plane_point(ring, registers, i, j);
    if (!point.exists) return kNoRay;
    const std::uint16_t image = look_up_rs_map(ring, point);
    if (image == kNoImage) return kNoRay;

    // Section 3: column of the captured image and rows along it.
    const CapturedView& view = object.views[image];
    const CapturedLine& line = view.lines[static_cast<std::size_t>(point.plane)];
    const std::int64_t l_q20 = line.l0_q20 + ((point.x_q20 * line.l1_q30) >> 30);
    if (l_q20 < kMinDepth_q20) return kNoRay;
    const std::int64_t lateral_q16 = line.q0_q16 + ((point.x_q20 * line.q1_q16) >> 20);
    const std::int64_t column = (view.cx_q16 + floor_divide(lateral_q16 * kOne_q20, l_q20)) >> 16;
    if (column < 0 || column >= object.width) return kNoRay;
    const std::int64_t m_q16 = (std::int64_t{view.fl_y_q16} << 20) / l_q20;
    if (m_q16 >= kLargestRowScale_q16) return kNoRay;

    const std::int64_t rise_q28 = (registers.rise.at_origin + i * registers.rise.per_column) >> 4;
    const std::int64_t height_q20 = registers.b_q20 + ((point.lambda_q20 * rise_q28) >> 28);
    const std::int64_t rise_per_row_q24 = (point.lambda_q20 * registers.rise.per_row) >> 28;
    if (rise_per_row_q24 < -kLargestRise_q24 || rise_per_row_q24 > kLargestRise_q24) return kNoRay;

    RaySetup setup;
    setup.image = image;
    setup.column = static_cast<int>(column);
    setup.lambda_q20 = static_cast<std::int32_t>(point.lambda_q20);
    setup.row_0_q16 = view.cy_q16 - ((m_q16 * (height_q20 - view.height_q20)) >> 20);
    setup.row_step_q16 = -((m_q16 * rise_per_row_q24) >> 24);
    return setup;
}

ViewRows rows_within(const RaySetup& ray, std::int32_t first, std::int32_t end, int height) {
    const auto ceil_divide = [](std::int64_t dividend, std::int64_t divisor) {
        return -floor_divide(-dividend, divisor);
    };
    const std::int64_t low = std::int64_t{first} << 16;  // first row inside the span
    const std::int64_t high = std::int64_t{end} << 16;   // first row after the span
    std::int64_t row_begin = 0;
    std::int64_t row_end = 0;
    if (ray.row_step_q16 > 0) {
        row_begin = ceil_divide(low - ray.row_0_q16, ray.row_step_q16);
        row_end = ceil_divide(high - ray.row_0_q16, ray.row_step_q16);
    } else if (ray.row_step_q16 < 0) {
        // Upside down: row(j) >= low while j <= (row_0 - low) / |step|, and row(j) < high once j > (row_0 - high) /
        // |step|.
        row_begin = ceil_divide(ray.row_0_q16 - high + 1, -ray.row_step_q16);
        row_end = ceil_divide(ray.row_0_q16 - low + 1, -ray.row_step_q16);
    } else if (ray.row_0_q16 >= low && ray.row_0_q16 < high) {
        row_end = height;
    }
    row_begin = std::clamp<std::int64_t>(row_begin, 0, height);
    row_end = std::clamp<std::int64_t>(row_end, row_begin, height);
    return {static_cast<std::int32_t>(row_begin), static_cast<std::int32_t>(row_end)};
}

}  // namespace rs::engine
