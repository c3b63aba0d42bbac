#pragma once
// Geometry of a shape map's line (rayspace/api/types/shape_map.hpp): its cells and their rays, in object radii.

#include "encode/raymap/silhouettes/visual_hull.hpp"
#include "encode/raymap/silhouettes/work_view.hpp"
#include "rayspace/api/types/shape_map.hpp"

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace rs::encode {

inline constexpr double kHalfWidth = kMaxDepth;  // of the ranges of p and depth
inline constexpr int kDepths = 256;
inline constexpr double kDepthStep = 2 * kHalfWidth / (kDepths - 1);

/// The grid of cells of one line, and the finer raster of its depth buffers.
struct LineGrid {
    int p_cells = 0, bands = 0;
    double p_low = 0, h_low = 0;
    double cells_per_unit = 0;
    double bands_per_unit = 0;
    double distance = 0, height = 0;  // of the reference viewpoint
    int fine = 1;                     // raster points along a cell's side

    /// The distance from the reference viewpoint to the foot of a ray at distance p from the axis.
    [[nodiscard]] double rho(double p) const {
        return std::sqrt(std::max(distance * distance - p * p, distance * distance / 4));
    }
};

struct LinePoint {
    double p = 0, h = 0, depth = 0;
};

/// Projects a point to a line's viewpoint.
LinePoint project_to_line(const LineGrid& grid, const glm::dvec2& viewpoint, const glm::dvec2& place, double y);

/// The ray from a line's viewpoint through the centres of the cells of column p, in the ground plan. Depths are cells'
/// depth steps, 0..255.
class CellRay {
public:
    CellRay(const LineGrid& grid, const glm::dvec2& viewpoint, int p_cell);

    [[nodiscard]] glm::dvec2 place(int depth) const { return ray_.place_at(-kHalfWidth + depth * kDepthStep); }
    /// The height of a band's centre at a depth, and the inverse: band coordinate n + 1/2 is the centre of band n.
    [[nodiscard]] double height(int band, int depth) const;
    [[nodiscard]] double bands_at(double height, int depth) const;

private:
    const LineGrid& grid_;
    double rho_;
    HorizontalRay ray_;
};

/// The depth nearest to `depth` for which `holds`; of two, the farther one; nullopt where there is none.
template <class Holds>
std::optional<std::uint8_t> nearest_depth(int depth, const Holds& holds) {
    for (int away = 0; away < kDepths; ++away) {
        for (const int d : {depth + away, depth - away}) {
            if (d >= 0 && d < kDepths && holds(d)) return static_cast<std::uint8_t>(d);
        }
    }
    return std::nullopt;
}

}  // namespace rs::encode
