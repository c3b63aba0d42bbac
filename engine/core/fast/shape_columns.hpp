#pragma once
// Columns of a captured image that a ray of an object with a shape map may sample, to decode them in advance.

#include "engine/core/definition/shape_setup.hpp"
#include "rayspace/object/ray_space_object.hpp"

namespace rs::engine {

// [first, last]; empty if last < first.
struct ColumnRange {
    int first = 0;
    int last = -1;
};

/// All columns that sample_image() (shape_pixel.hpp) reads at any depth 0 .. 255; the range may be a little larger.
ColumnRange sampled_columns(const RaySpaceObject& object, const ShapeImage& image);

}  // namespace rs::engine
