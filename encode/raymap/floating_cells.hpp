#pragma once
// Removes cells of a shape map's line that float beside the object, where no photo shows a surface.

#include "encode/raymap/line_grid.hpp"
#include "encode/raymap/silhouettes/work_view.hpp"
#include "rayspace/api/types/shape_map.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <vector>

namespace rs::encode {

/// Removes surfaces whose ray misses the hull together with all 8 neighbors' rays: their depths are wrong. A surface
/// next to a ray that meets the hull is kept, since a part thinner than a cell may not cover its centre. \param
/// meets_hull  not 0 where the ray of a cell meets the hull, [p * bands + h] as `cells`.
void remove_cells_outside_hull(const LineGrid& grid, const std::vector<std::uint8_t>& meets_hull, ShapeCell* cells);

/// The size, relative to a line's largest connected component, below which a component does not belong to the object,
/// 0 .. kMaxFloatingShare. Where photos are far apart, corners of the hull stick out between them, and surfaces there
/// are separated from the object. Half of the relative size of the depth map's smallest component where that is less,
/// since objects may have small parts.
inline constexpr double kMaxFloatingShare = 0.01;
double floating_share(const Image<float>& depth);

/// Removes 4-connected components of cells with surfaces that are smaller than `share` of the largest.
void remove_small_components(const LineGrid& grid, double share, ShapeCell* cells);

}  // namespace rs::encode
