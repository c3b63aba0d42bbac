#pragma once
// The cells of a shape map as planes of bytes, which is what the file compresses: which cells have a surface, and for
// each of its two depths the residuals against a prediction. encode/FORMAT.md, section "shap", "Planes".

#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::shape_coding {

// What a cell with a surface holds.
enum class Depth : std::uint8_t { kSurface, kBack };
inline constexpr std::array<Depth, 2> kDepths = {Depth::kSurface, Depth::kBack};

inline std::size_t surface_plane_bytes(std::size_t cells) {
    return (cells + 7) / 8;
}

// Cells that have a surface; a residual plane has one byte for each.
std::size_t surfaces_of(const ShapeMap& shape);

std::vector<std::uint8_t> surface_plane(const ShapeMap& shape);
std::vector<std::uint8_t> residual_plane(const ShapeMap& shape, Depth depth);

// The reverse, into shape.cells, which has its size and is zero before: first the surfaces, then their depths, then the
// backs. `plane` must be surface_plane_bytes(shape.cells.size()) or surfaces_of() long. Until its back is put, a cell
// with a surface has the back 1.
Status put_surfaces(std::span<const std::uint8_t> plane, ShapeMap& shape);
void put_residuals(std::span<const std::uint8_t> plane, Depth depth, ShapeMap& shape);

}  // namespace rs::shape_coding
