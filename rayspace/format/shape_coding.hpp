#pragma once
// Entropy coding of a shape map's cells with a binary arithmetic coder: encode/FORMAT.md, section "shap", "Cells".

#include "rayspace/api/types/shape_map.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace rs::shape_coding {

/// Encodes the cells of a valid map. Deterministic.
std::vector<std::byte> encode_cells(const ShapeMap& shape);

/// Decodes into shape.cells, which has its size. Any bytes decode to valid cells.
void decode_cells(std::span<const std::byte> bytes, ShapeMap& shape);

/// Replaces each depth by its prediction, which takes almost no bits, if that is at most `tolerance` steps away.
void snap_depths(ShapeMap& shape, int tolerance);

}  // namespace rs::shape_coding
