#pragma once
// From depths of captured pictures to the cells of a shape map (rayspace/object/shape_map.hpp): every line of every gap
// sees the surfaces of the two pictures beside it, moved to its own viewpoint.

#include "encode/raymap/silhouettes/visual_hull.hpp"
#include "encode/raymap/silhouettes/work_view.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/shape_map.hpp"

#include <vector>

namespace rs::encode {

struct ShapeLinesOptions {
    double cell_px = 2.0;   // side of a cell in pixels of the working pictures
    int raster_points = 3;  // on it, of the raster on which pictures' depths meet: fewer fatten what stands in front
    double line_deg = 2;    // a gap of n times that has n - 1 lines, rounded up, and one at least
    int jump = 24;          // depth steps between neighbouring cells that are still one surface, 1..255
    int thickness = 8;      // of the object behind its surfaces, depth steps, 0..255
    // A depth may be off by what moves a point by so many pixels of the working pictures between a line and the
    // pictures beside it, and by this many steps at most: then most are what the file's prediction says.
    double settled_px = 0.15;
    int most_settled = 3;
    double widest_gap_deg = 45.01;  // wider ones stay without lines
};

// Surfaces and the hull that encloses them.
struct SurfaceLayer {
    const std::vector<DepthView>& ring;  // in turning order
    const SampledHull& hull;
    bool silhouettes_agree = true;  // else the hull moves surfaces, but removes none
    bool in_front = true;           // of what the pictures show beside it; else pictures' other pixels may hide it
};

// From view n of a ring to the next one in turning order, above 0 and at most 2 pi.
double gap_width(const std::vector<DepthView>& ring, std::size_t n);

// Layers of the same pictures, one at least; a cell is of the first that has a surface there. All but normal_lines is
// filled in.
ShapeMap make_shape_lines(const std::vector<SurfaceLayer>& layers, const ShapeLinesOptions& options);

}  // namespace rs::encode
