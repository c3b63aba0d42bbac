#include "engine/core/definition/shape_setup.hpp"

#include "engine/core/definition/fixed_point.hpp"
#include "engine/core/definition/ray_setup.hpp"

#include <algorithm>

namespace rs::engine {
namespace {

constexpr std::int64_t kMaxPerStep = std::int64_t{1} << 20;
constexpr std::int64_t kMaxFootDepth_q20 = std::int64_t{1} << 29;

// Horizontal projection of a ray: passes its foot in direction (sine, -cosine) along (tangent, normal).
struct VerticalPlaneRay {
    std::int64_t r_q28 = 0;  // horizontal length of the pixel's direction
    std::int64_t cosine_q30 = 0;
    std::int64_t sine_q30 = 0;
    std::int64_t p_q20 = 0;  // signed distance of the ray from the axis
};

VerticalPlaneRay vertical_plane_ray(const PlanePoint& point) {
    VerticalPlaneRay ray;
    ray.r_q28 = floor_square_root(point.n_q28 * point.n_q28 + point.t_q28 * point.t_q28);
    ray.cosine_q30 = floor_divide(point.n_q28 * (std::int64_t{1} << 30), ray.r_q28);
    ray.sine_q30 = floor_divide(point.t_q28 * (std::int64_t{1} << 30), ray.r_q28);
    ray.p_q20 = (point.x_q20 * ray.cosine_q30) >> 30;
    return ray;
}

struct Bracket {
    int gap = -1;  // -1: the ray lies in no gap that has lines
    std::int64_t from_first_q20 = 0;
    std::int64_t width_q20 = 0;  // above 0
};

// Position on the plane of the parallel ray from view n of the ring (equation 1).
std::int64_t crossing_q20(const Ring& ring, int n, const PlanePoint& point) {
    const NormalLine& line =
        ring.shape.normal_lines[static_cast<std::size_t>(n) * static_cast<std::size_t>(ring.planes) +
                                static_cast<std::size_t>(point.plane)];
    return line.a_q20 + ((point.u_q28 * line.c_q20) >> 28);
}

// Finds the gap whose two captured rays bracket the view ray. `hint`: index in the ring of the RS map's view, where the
// search starts.
Bracket find_bracket(const Ring& ring, int hint, const PlanePoint& point) {
    const int count = static_cast<int>(ring.views.size());
    int gap = crossing_q20(ring, hint, point) <= point.x_q20 ? hint : (hint + count - 1) % count;
    for (int step = 0; step < count; ++step) {
        if (ring.shape.gaps[static_cast<std::size_t>(gap)].lines == 0) return {};
        const std::int64_t first = crossing_q20(ring, gap, point);
        const std::int64_t second = crossing_q20(ring, (gap + 1) % count, point);
        if (point.x_q20 < first) {
            gap = (gap + count - 1) % count;
        } else if (point.x_q20 >= second) {
            gap = (gap + 1) % count;
        } else {
            return {gap, point.x_q20 - first, second - first};
        }
    }
    return {};
}

// Position between two neighbouring samples, in eighths.
struct InterpolationPosition {
    std::int64_t first = 0;  // the second is first + 1
    std::int32_t part = 0;
};

// `at_q8`: position in samples; sample n is located at n + 1/2.
InterpolationPosition between_samples(std::int64_t at_q8) {
    const std::int64_t from_middle_q8 = at_q8 - 128;
    return {from_middle_q8 >> 8, static_cast<std::int32_t>((from_middle_q8 >> 5) & 7)};
}

// Cell columns around the ray. The neighbours of the first and the last line of a gap are in the adjacent gaps, if
// these have lines.
CellColumns cells_around(const ShapeMap& shape, const Bracket& bracket, std::int64_t p_q20) {
    const std::size_t gaps = shape.gaps.size();
    const auto n = static_cast<std::size_t>(bracket.gap);
    const ShapeGap& gap = shape.gaps[n];
    const ShapeGap& before = shape.gaps[(n + gaps - 1) % gaps];
    const ShapeGap& after = shape.gaps[(n + 1) % gaps];
    const InterpolationPosition p = between_samples(((p_q20 + shape.p_half_q20) * shape.p_cells_per_unit_q12) >> 24);
    const InterpolationPosition line =
        between_samples(bracket.from_first_q20 * (std::int64_t{256} * gap.lines) / bracket.width_q20);
    CellColumns columns;
    columns.p_part = p.part;
    columns.line_part = line.part;
    for (int l = 0; l < 2; ++l) {
        std::int64_t number = gap.first_line + std::clamp<std::int64_t>(line.first + l, 0, gap.lines - 1);
        if (line.first + l < 0 && before.lines > 0) number = before.first_line + before.lines - 1;
        if (line.first + l >= gap.lines && after.lines > 0) number = after.first_line;
        for (int c = 0; c < 2; ++c) {
            const std::int64_t cell = std::clamp<std::int64_t>(p.first + c, 0, shape.p_cells - 1);
            columns.at[c][l] = shape.cells.data() + (number * shape.p_cells + cell) * shape.bands;
        }
    }
    return columns;
}

// Depth steps of a ray: step n is at low + n * step behind the foot. All 0 for a ray without a shape.
struct DepthSteps {
    std::int64_t low_q20 = 0;
    std::int64_t step_q24 = 0;
};

// Coefficients of the projection into view n of the ring.
ShapeImage along_ray(const RaySpaceObject& object, const Ring& ring, int n, int plane, const VerticalPlaneRay& ray,
                     const DepthSteps& depth) {
    const int view = ring.views[static_cast<std::size_t>(n)];
    const CapturedLine& line = object.views[static_cast<std::size_t>(view)].lines[static_cast<std::size_t>(plane)];
    const NormalLine& normal =
        ring.shape.normal_lines[static_cast<std::size_t>(n) * static_cast<std::size_t>(ring.planes) +
                                static_cast<std::size_t>(plane)];
    const std::int64_t x_q20 = (ray.p_q20 * ray.cosine_q30) >> 30;
    const std::int64_t z_q20 = (ray.p_q20 * ray.sine_q30) >> 30;
    const std::int64_t l_foot_q20 = line.l0_q20 + ((x_q20 * line.l1_q30 + z_q20 * normal.l2_q30) >> 30);
    const std::int64_t l_along_q30 = (ray.sine_q30 * line.l1_q30 - ray.cosine_q30 * normal.l2_q30) >> 30;
    const std::int64_t n_foot_q16 = line.q0_q16 + ((x_q20 * line.q1_q16 + z_q20 * normal.q2_q16) >> 20);
    const std::int64_t n_along_q16 = (ray.sine_q30 * line.q1_q16 - ray.cosine_q30 * normal.q2_q16) >> 30;
    ShapeImage image;
    image.view = view;
    image.l0_q20 = static_cast<std::int32_t>(l_foot_q20 + ((depth.low_q20 * l_along_q30) >> 30));
    image.l1_q24 = static_cast<std::int32_t>((depth.step_q24 * l_along_q30) >> 30);
    image.n0_q12 = static_cast<std::int32_t>((n_foot_q16 + ((depth.low_q20 * n_along_q16) >> 20)) >> 4);
    image.n1_q12 =
        static_cast<std::int32_t>(std::clamp((depth.step_q24 * n_along_q16) >> 28, -kMaxPerStep, kMaxPerStep));
    return image;
}

}  // namespace

ShapeSetup set_up_shape(const RaySpaceObject& object, const ViewRegisters& registers, int i, int j) {
    const Ring& ring = object.rings[static_cast<std::size_t>(registers.ring)];
    const ShapeMap& shape = ring.shape;
    const PlanePoint point = plane_point(ring, registers, i, j);
    if (!point.exists) return {};
    const std::uint16_t hint = look_up_rs_map(ring, point);
    if (hint == kNoImage) return {};
    const auto place = std::find(ring.views.begin(), ring.views.end(), hint) - ring.views.begin();

    const VerticalPlaneRay ray = vertical_plane_ray(point);
    const PlaneRegisters& plane = registers.planes[static_cast<std::size_t>(point.plane)];
    const std::int64_t to_foot_q20 = (plane.c_q20 * ray.cosine_q30 - plane.a_q20 * ray.sine_q30) >> 30;
    const std::int64_t lambda_foot_q20 = floor_divide(to_foot_q20 * (std::int64_t{1} << 28), ray.r_q28);
    if (lambda_foot_q20 <= -kMaxFootDepth_q20 || lambda_foot_q20 >= kMaxFootDepth_q20) return {};

    ShapeSetup setup;
    setup.has_ray = true;
    setup.lambda_foot_q20 = static_cast<std::int32_t>(lambda_foot_q20);
    setup.inverse_r_q20 = static_cast<std::int32_t>((std::int64_t{1} << 48) / ray.r_q28);
    const std::int64_t distance_q20 = shape.reference_distance_q20;
    const std::int64_t rho_q20 = floor_square_root(
        std::max(distance_q20 * distance_q20 - ray.p_q20 * ray.p_q20, (distance_q20 * distance_q20) / 4));
    setup.inverse_rho_q20 = static_cast<std::int32_t>((std::int64_t{1} << 40) / rho_q20);

    const Bracket bracket = find_bracket(ring, static_cast<int>(place), point);
    DepthSteps depth;
    if (bracket.gap >= 0) {
        depth = {shape.depth_low_q20, shape.depth_step_q24};
        setup.cells = cells_around(shape, bracket, ray.p_q20);
        setup.foot_depth_q3 =
            static_cast<std::int32_t>(std::clamp<std::int64_t>(-depth.low_q20 * 128 / depth.step_q24, 0, 255 * 8));
        setup.weight =
            static_cast<std::int32_t>((bracket.from_first_q20 * 512 + bracket.width_q20) / (2 * bracket.width_q20));
        const int next = (bracket.gap + 1) % static_cast<int>(ring.views.size());
        setup.first = along_ray(object, ring, bracket.gap, point.plane, ray, depth);
        setup.second = along_ray(object, ring, next, point.plane, ray, depth);
    } else {
        setup.first = along_ray(object, ring, static_cast<int>(place), point.plane, ray, depth);
    }
    setup.lambda0_q20 =
        static_cast<std::int32_t>(lambda_foot_q20 + floor_divide(depth.low_q20 * (std::int64_t{1} << 28), ray.r_q28));
    setup.lambda1_q21 = static_cast<std::int32_t>((depth.step_q24 << 25) / ray.r_q28);
    return setup;
}

}  // namespace rs::engine
