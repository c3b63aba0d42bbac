#include "datasets-synthetic/shapes/surfaces.hpp"

#include <algorithm>
#include <utility>

namespace rs::synthetic {
namespace {

using glm::vec3;

// The area ratio of the ellipsoid to the unit sphere at a point is |area_stretch * sphere point|.
vec3 area_stretch(vec3 r) {
    return {r.y * r.z, r.x * r.z, r.x * r.y};
}

float largest(vec3 v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

void append_ellipsoid(capture::Mesh& mesh, const Ellipsoid& ellipsoid, int columns, int rows) {
    Grid grid(columns, rows, true);
    grid.normals.resize(grid.positions.size());
    for (int j = 0; j <= rows; ++j) {
        const double latitude_rad = kPi * (static_cast<double>(j) / rows - 0.5);
        const bool pole = j == 0 || j == rows;
        const auto ring = static_cast<float>(pole ? 0.0 : portable::cos(latitude_rad));
        const auto height = static_cast<float>(portable::sin(latitude_rad));
        for (int i = 0; i <= columns; ++i) {
            const double angle_rad = 2.0 * kPi * i / columns;
            const vec3 on_sphere{ring * static_cast<float>(portable::sin(angle_rad)), height,
                                 ring * static_cast<float>(portable::cos(angle_rad))};
            const std::size_t k = grid.index(i, j);
            grid.positions[k] = ellipsoid.frame.point(on_sphere * ellipsoid.radii);
            grid.normals[k] = glm::normalize(ellipsoid.frame.direction(on_sphere / ellipsoid.radii));
            grid.uvs[k] = {static_cast<float>(i) / static_cast<float>(columns),
                           static_cast<float>(j) / static_cast<float>(rows)};
        }
    }
    append_grid(mesh, std::move(grid));
}

RejectionSample sample_surface(const Ellipsoid& ellipsoid, Random& random) {
    const vec3 on_sphere = random.direction();
    const vec3 stretch = area_stretch(ellipsoid.radii);
    const bool keep = random.uniform() * largest(stretch) < glm::length(stretch * on_sphere);
    return {{ellipsoid.frame.point(on_sphere * ellipsoid.radii),
             glm::normalize(ellipsoid.frame.direction(on_sphere / ellipsoid.radii))},
            keep};
}

float sampling_weight(const Ellipsoid& ellipsoid) {
    return largest(area_stretch(ellipsoid.radii));
}

}  // namespace rs::synthetic
