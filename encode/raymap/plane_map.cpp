#include "encode/raymap/plane_map.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/geometry/ray_space.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::encode {
namespace {

// The map extends slightly beyond tan(pi / K), so that rays at the seam between two planes are inside of both.
double half_width_of_u(int planes) {
    return std::tan(kPi / planes) * (1 + 1.0 / 1024);
}

// A ray at this angle to the normal that touches the unit cylinder crosses the plane at 1 / cos(pi / K). The margin
// keeps the soft pixels of a silhouette's edge, which extend half a pixel beyond the object.
double half_width_of_x(int planes) {
    return (1 + 1.0 / 64) / std::cos(kPi / planes);
}

// Offset of the border between two photos from halfway, in cells of u.
constexpr double kFavour_cells = 2;

struct Candidate {
    double angle_rad = 0;  // between the photo's ray through the plane point and the normal
    std::uint16_t view = kNoImage;
};

// The rays of the ring's photos through the plane point x, sorted by angle.
std::vector<Candidate> rays_through(const Rig& upright, const ViewRing& ring, const ReferencePlane& plane, double x) {
    std::vector<Candidate> rays;
    for (const int v : ring.views) {
        const Camera& camera = upright.views[static_cast<std::size_t>(v)].camera;
        const ViewpointLine line = viewpoint_line(camera.centre(), plane);
        if (line.c <= 1e-3) continue;
        const glm::dvec3 pixel = camera.project(x * plane.tangent + glm::dvec3(0, camera.centre().y, 0));
        if (pixel.z <= 0 || pixel.x < 0 || pixel.x >= camera.width) continue;
        rays.push_back({std::atan(line.u_at(x)), static_cast<std::uint16_t>(v)});
    }
    std::stable_sort(rays.begin(), rays.end(),
                     [](const Candidate& a, const Candidate& b) { return a.angle_rad < b.angle_rad; });
    return rays;
}

// A viewpoint halfway between two captured ones follows the border between their cells. With the border exactly
// halfway, rounding would assign its columns to both photos in turn, and stripes would be visible from such viewpoints.
// The border is therefore slightly beyond halfway.
bool is_next_nearer(const Candidate& now, const Candidate& next, double angle_rad, double cell_rad) {
    const double apart_rad = next.angle_rad - now.angle_rad;
    const double favour_rad = std::min(kFavour_cells * cell_rad, apart_rad / 8);
    return angle_rad - now.angle_rad > apart_rad / 2 + favour_rad;
}

}  // namespace

Ring make_plane_map(const Rig& upright, const ViewRing& view_ring, const PlaneMapOptions& options) {
    Ring ring;
    ring.elevation_udeg = static_cast<std::int32_t>(std::lround(degrees(view_ring.elevation_rad) * 1e6));
    ring.planes = options.planes;
    ring.x_cells = options.x_cells;
    ring.u_cells = options.u_cells;
    const double x_half = half_width_of_x(options.planes);
    ring.x_half_q20 = static_cast<std::int32_t>(std::lround(std::ldexp(x_half, 20)));
    ring.x_cells_per_unit_q12 = static_cast<std::int32_t>(std::lround(std::ldexp(options.x_cells / (2 * x_half), 12)));
    const double u_half = half_width_of_u(options.planes);
    ring.u_half_q28 = static_cast<std::int32_t>(std::lround(std::ldexp(u_half, 28)));
    ring.u_cells_per_unit_q12 = static_cast<std::int32_t>(std::lround(std::ldexp(options.u_cells / (2 * u_half), 12)));
    for (const int v : view_ring.views) ring.views.push_back(static_cast<std::uint16_t>(v));
    ring.cells.assign(static_cast<std::size_t>(options.planes) * static_cast<std::size_t>(options.x_cells) *
                          static_cast<std::size_t>(options.u_cells),
                      kNoImage);

    for_each_index(options.planes * options.x_cells, [&](int row) {
        const int k = row / options.x_cells;
        const int xi = row % options.x_cells;
        const double x = -x_half + (xi + 0.5) * 2 * x_half / options.x_cells;
        const auto rays = rays_through(upright, view_ring, reference_plane(k, options.planes), x);
        if (rays.empty()) return;
        std::size_t nearest = 0;
        for (int ui = 0; ui < options.u_cells; ++ui) {
            const double u = -u_half + (ui + 0.5) * 2 * u_half / options.u_cells;
            const double angle = std::atan(u);
            const double cell_rad = 2 * u_half / options.u_cells / (1 + u * u);
            while (nearest + 1 < rays.size() && is_next_nearer(rays[nearest], rays[nearest + 1], angle, cell_rad))
                ++nearest;
            ring.cells[ring.cell_index(k, xi, ui)] = rays[nearest].view;
        }
    });
    return ring;
}

double cells_between_views(const Rig& upright, const ViewRing& ring, const PlaneMapOptions& options) {
    if (ring.views.size() < 2) return 0;
    const double cells_per_unit = options.u_cells / (2 * half_width_of_u(options.planes));
    double narrowest = 1e30;
    for (int k = 0; k < options.planes; ++k) {
        const auto rays = rays_through(upright, ring, reference_plane(k, options.planes), 0);
        for (std::size_t i = 1; i < rays.size(); ++i) {
            const double u0 = std::tan(rays[i - 1].angle_rad);
            const double u1 = std::tan(rays[i].angle_rad);
            const double half = half_width_of_u(options.planes);
            if (u0 < -half || u1 > half) continue;
            narrowest = std::min(narrowest, (u1 - u0) * cells_per_unit);
        }
    }
    return narrowest > 1e29 ? 0 : narrowest;
}

}  // namespace rs::encode
