#include "engine/core/definition/plane_point.hpp"

#include "engine/core/definition/fixed_point.hpp"

namespace rs::engine {
namespace {

constexpr std::int64_t kMostEdgeOn_q28 = std::int64_t{1} << 24;
constexpr std::int64_t kFarthestPlane_q20 = std::int64_t{1} << 29;

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
    if (plane.c_q20 <= 0 || point.n_q28 < kMostEdgeOn_q28) return kNone;
    point.t_q28 = plane.along_tangent.at(i, j) >> 4;
    const std::int64_t c_q20 = plane.c_q20;
    point.u_q28 = floor_divide(point.t_q28 * (std::int64_t{1} << 28), point.n_q28);
    point.x_q20 = plane.a_q20 + ((point.u_q28 * c_q20) >> 28);
    point.lambda_q20 = (c_q20 << 28) / point.n_q28;
    point.exists =
        point.x_q20 >= -ring.x_half_q20 && point.x_q20 < ring.x_half_q20 && point.lambda_q20 < kFarthestPlane_q20;
    return point;
}

std::uint16_t map_answer(const Ring& ring, const PlanePoint& point) {
    const std::int64_t xi = ((point.x_q20 + ring.x_half_q20) * ring.x_cells_per_unit_q12) >> 32;
    const std::int64_t ui = ((point.u_q28 + ring.u_half_q28) * ring.u_cells_per_unit_q12) >> 40;
    return ring.cells[ring.cell_index(point.plane, clamped(xi, ring.x_cells), clamped(ui, ring.u_cells))];
}

}  // namespace rs::engine
