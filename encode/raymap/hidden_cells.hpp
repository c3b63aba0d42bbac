#pragma once
// Cells of a shape map whose surface one of the two pictures does not show, since another surface hides it there.

#include "encode/raymap/line_grid.hpp"
#include "encode/raymap/silhouettes/work_view.hpp"
#include "rayspace/object/shape_map.hpp"

#include <glm/vec2.hpp>

namespace rs::encode {

// The pictures beside a line, whose viewpoint this is.
struct LinePictures {
    const DepthView& first;
    const DepthView& second;
    glm::dvec2 viewpoint;
};

// Moves surfaces that a picture's other layer hides along the line's ray to the nearest depth at which none does, which
// is beside the rim of what hides it, for both pictures' rays are blended; where there is none it is removed. `cells`:
// the bands of one p.
void avoid_hidden(const LineGrid& grid, const LinePictures& pictures, int p_cell, ShapeCell* cells);

// Says of each surface which of the pictures show it: both, where their depths are not to be trusted.
void say_who_shows(const LineGrid& grid, const LinePictures& pictures, bool trust_depths, int p_cell, ShapeCell* cells);

}  // namespace rs::encode
