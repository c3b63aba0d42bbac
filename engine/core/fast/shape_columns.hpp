#pragma once
// Which columns of a captured image a ray with height may read: to have them decoded before it does.

#include "engine/core/definition/shape_setup.hpp"
#include "rayspace/object/ray_space_object.hpp"

namespace rs::engine {

// [first, last]; last < first where none is read.
struct ColumnRange {
    int first = 0;
    int last = -1;
};

// All columns that sample_image() (shape_pixel.hpp) takes texels from at any depth 0 .. 255, and perhaps a few more.
ColumnRange columns_read(const RaySpaceObject& object, const ShapeImage& image);

}  // namespace rs::engine
