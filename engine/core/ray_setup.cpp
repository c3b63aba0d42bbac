#include "engine/core/ray_setup.hpp"

#include <algorithm>

namespace rs::engine {
namespace {

constexpr std::int64_t kOne_q20 = std::int64_t{1} << 20;
constexpr std::int64_t kMostEdgeOn_q28 = std::int64_t{1} << 24;
constexpr std::int64_t kFarthestPlane_q20 = std::int64_t{1} << 29;
constexpr std::int64_t kNearestDepth_q20 = std::int64_t{1} << 17;
constexpr std::int64_t kLargestRowScale_q16 = std::int64_t{1} << 30;
constexpr std::int64_t kLargestRise_q24 = std::int64_t{1} << 28;

// Rounds towards minus infinity; divisor > 0.
constexpr std::int64_t floor_divide(std::int64_t dividend, std::int64_t divisor) {
    const std::int64_t quotient = dividend / divisor;
    return quotient * divisor > dividend ? quotient - 1 : quotient;
}

int clamped(std::int64_t cell, int cells) {
    return static_cast<int>(std::clamp<std::int64_t>(cell, 0, cells - 1));
}

}  // namespace

RaySetup set_up_ray(const RaySpaceObject& object, const ViewRegisters& registers, int i, int j) {
    constexpr RaySetup kNoRay;
    const Ring& ring = object.rings[static_cast<std::size_t>(registers.ring)];

    // Section 2: the plane, and the ray's place (x, u) on it.
    int k = 0;
    std::int64_t smallest = registers.planes[0].along_normal.at(i, j) >> 4;
    for (int candidate = 1; candidate < ring.planes; ++candidate) {
        const std::int64_t n = registers.planes[static_cast<std::size_t>(candidate)].along_normal.at(i, j) >> 4;
        if (n < smallest) {
            smallest = n;
            k = candidate;
        }
    }
    const PlaneRegisters& plane = registers.planes[static_cast<std::size_t>(k)];
    const std::int64_t n_q28 = -smallest;
    if (plane.c_q20 <= 0 || n_q28 < kMostEdgeOn_q28) return kNoRay;
    const std::int64_t t_q28 = plane.along_tangent.at(i, j) >> 4;
    const std::int64_t c_q20 = plane.c_q20;
    const std::int64_t u_q28 = floor_divide(t_q28 * (std::int64_t{1} << 28), n_q28);
    const std::int64_t x_q20 = plane.a_q20 + ((u_q28 * c_q20) >> 28);
    const std::int64_t lambda_q20 = (c_q20 << 28) / n_q28;
    if (x_q20 < -ring.x_half_q20 || x_q20 >= ring.x_half_q20 || lambda_q20 >= kFarthestPlane_q20) return kNoRay;

    const std::int64_t xi = ((x_q20 + ring.x_half_q20) * ring.x_cells_per_unit_q12) >> 32;
    const std::int64_t ui = ((u_q28 + ring.u_half_q28) * ring.u_cells_per_unit_q12) >> 40;
    const std::uint16_t picture = ring.cells[ring.cell_index(k, clamped(xi, ring.x_cells), clamped(ui, ring.u_cells))];
    if (picture == kNoPicture) return kNoRay;

    // Section 3: the picture's column, and the rows along it.
    const CapturedView& view = object.views[picture];
    const CapturedLine& line = view.lines[static_cast<std::size_t>(k)];
    const std::int64_t l_q20 = line.l0_q20 + ((x_q20 * line.l1_q30) >> 30);
    if (l_q20 < kNearestDepth_q20) return kNoRay;
    const std::int64_t lateral_q16 = line.q0_q16 + ((x_q20 * line.q1_q16) >> 20);
    const std::int64_t column = (view.cx_q16 + floor_divide(lateral_q16 * kOne_q20, l_q20)) >> 16;
    if (column < 0 || column >= object.width) return kNoRay;
    const std::int64_t m_q16 = (std::int64_t{view.fl_y_q16} << 20) / l_q20;
    if (m_q16 >= kLargestRowScale_q16) return kNoRay;

    const std::int64_t rise_q28 = (registers.rise.at_origin + i * registers.rise.per_column) >> 4;
    const std::int64_t height_q20 = registers.b_q20 + ((lambda_q20 * rise_q28) >> 28);
    const std::int64_t rise_per_row_q24 = (lambda_q20 * registers.rise.per_row) >> 28;
    if (rise_per_row_q24 < -kLargestRise_q24 || rise_per_row_q24 > kLargestRise_q24) return kNoRay;

    RaySetup setup;
    setup.picture = picture;
    setup.column = static_cast<int>(column);
    setup.row_0_q16 = view.cy_q16 - ((m_q16 * (height_q20 - view.height_q20)) >> 20);
    setup.row_step_q16 = -((m_q16 * rise_per_row_q24) >> 24);
    return setup;
}

}  // namespace rs::engine
