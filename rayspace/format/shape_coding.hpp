#pragma once
// The cells of a shape map as the bytes of a binary arithmetic coder: encode/FORMAT.md, section "shap", "Cells".

#include "rayspace/object/shape_map.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace rs::shape_coding {

// The map must be valid. The same cells give the same bytes.
std::vector<std::byte> coded_cells(const ShapeMap& shape);

// The reverse, into shape.cells, which has its size. Any bytes are those of some valid cells.
void put_cells(std::span<const std::byte> bytes, ShapeMap& shape);

// Makes each depth what it is predicted to be, which takes next to nothing in the file, where that is at most
// `tolerance` steps away.
void settle_depths(ShapeMap& shape, int tolerance);

}  // namespace rs::shape_coding
