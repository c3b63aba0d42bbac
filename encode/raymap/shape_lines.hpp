#pragma once
// Computes the cells of a shape map (rayspace/api/types/shape_map.hpp) from the photos' depth maps: the depth maps on
// either side of each line of rays are reprojected to the line's viewpoint and merged, and cells that float beside the
// object, where no photo shows a surface, are removed (floating_cells.cpp).

#include "encode/raymap/line_grid.hpp"
#include "encode/raymap/silhouettes/visual_hull.hpp"
#include "encode/raymap/silhouettes/work_view.hpp"
#include "rayspace/api/types/shape_map.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <vector>

namespace rs::encode {

struct ShapeLinesOptions {
    double cell_px = 2.0;   // side of a cell in pixels of the working views
    int raster_points = 3;  // of the depth buffer along a cell's side; fewer dilate surfaces in front
    double line_deg = 2;    // a gap of n times this angle has n - 1 lines, rounded up, and at least one
    int jump = 24;          // largest step between neighbouring cells of one surface, depth steps, 1..255
    int thickness = 8;      // of the object behind its surfaces, depth steps, 0..255
    // Depths are moved towards the file's prediction to save bits: by at most this many steps, and so that a point
    // moves by at most this many pixels of a working view between a line and the photos beside it.
    double depth_shift_px = 0.15;
    int max_depth_shift = 3;
    double max_gap_deg = 45.01;  // wider gaps have no lines
};

/// The depth maps of one layer of surfaces, and the hull that encloses them; null if the depths are exact.
struct SurfaceLayer {
    const std::vector<DepthView>& ring;  // in turning order, each with depth and occluders
    const SampledHull* hull;
    bool silhouettes_agree = true;  // false: the hull moves surfaces but removes none, and all are shown by both photos
    bool in_front = true;           // false: the photos' other pixels may cover this layer
};

/// Removes surfaces whose ray misses the hull together with all 8 neighbors' rays: their depths are wrong. A surface
/// next to a ray that meets the hull is kept, since a part thinner than a cell may not cover its centre.
/// \param meets_hull  not 0 where the ray of a cell meets the hull, [p * bands + h] as `cells`.
void remove_cells_outside_hull(const LineGrid& grid, const std::vector<std::uint8_t>& meets_hull, ShapeCell* cells);

/// The size, relative to a line's largest connected component, below which a component does not belong to the object,
/// 0 .. kMaxFloatingShare. Where photos are far apart, corners of the hull stick out between them, and surfaces there
/// are separated from the object. Half of the relative size of the depth map's smallest component where that is less,
/// since objects may have small parts.
inline constexpr double kMaxFloatingShare = 0.01;
double floating_share(const Image<float>& depth);

/// Removes 4-connected components of cells with surfaces that are smaller than `share` of the largest.
void remove_small_components(const LineGrid& grid, double share, ShapeCell* cells);

/// The angle from view n of a ring to the next one in turning order, radians, above 0 and at most 2 pi.
double gap_width(const std::vector<DepthView>& ring, std::size_t n);

/// Computes everything of a ring's shape map but normal_lines.
/// \param layers  at least one, of the same photos; a cell belongs to the first layer that has a surface there.
ShapeMap make_shape_lines(const std::vector<SurfaceLayer>& layers, const ShapeLinesOptions& options);

}  // namespace rs::encode
