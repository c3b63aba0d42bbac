#pragma once
// Cells of a shape map's line that float beside the object: no picture shows anything there.

#include "encode/raymap/line_grid.hpp"
#include "encode/raymap/silhouettes/work_view.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/shape_map.hpp"

#include <cstdint>
#include <vector>

namespace rs::encode {

// Removes surfaces whose ray misses the hull, and all of whose neighbours do: no picture's depth was true there. One
// beside a ray that meets the hull stays, since a part thinner than a cell may pass by its middle. `meets_hull`: not 0
// where the ray of a cell meets it. Cells are [p * bands + h].
void drop_beside_hull(const LineGrid& grid, const std::vector<std::uint8_t>& meets_hull, ShapeCell* cells);

// Below this share of the largest island an island of a line is none of the object's, 0 .. kLargestFloating: where
// pictures stand far apart, corners of the hull stick out between them, and what fills these is torn off the object.
// Half of what the smallest island of the picture's surface has of its largest, if that is less: objects have small
// parts, too.
inline constexpr double kLargestFloating = 0.01;
double floating_share(const Image<float>& depth);

// Removes islands (cells with a surface beside, above and below one another) below `share` of the largest.
void drop_islands(const LineGrid& grid, double share, ShapeCell* cells);

}  // namespace rs::encode
