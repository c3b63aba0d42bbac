#pragma once
// The cells of a shape map as planes of bytes, which is what the file compresses: which layers a cell has and who sees
// them, and for each of its depths the residuals against a prediction. encode/FORMAT.md, section "shap",
// "Planes".

#include "rayspace/ray_space_object.hpp"
#include "rayspace/result.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::shape_coding {

// What a cell holds besides its rays.
enum class Depth : std::uint8_t { kLayer0, kLayer1, kBack };
inline constexpr std::array<Depth, 3> kDepths = {Depth::kLayer0, Depth::kLayer1, Depth::kBack};

inline std::size_t rays_plane_bytes(std::size_t cells) {
    return (cells + 1) / 2;
}

// Cells that have the depth: those with layer 0, with layer 1, with layer 0. Its residual plane has one byte for each.
std::size_t cells_with(const ShapeMap& shape, Depth depth);

std::vector<std::uint8_t> rays_plane(const ShapeMap& shape);
std::vector<std::uint8_t> residual_plane(const ShapeMap& shape, Depth depth);

// The reverse, into shape.cells, which has its size and is zero before: first the rays, then the depths.
// `plane` must be rays_plane_bytes(shape.cells.size()) or cells_with() long.
Status put_rays(std::span<const std::uint8_t> plane, ShapeMap& shape);
void put_residuals(std::span<const std::uint8_t> plane, Depth depth, ShapeMap& shape);

}  // namespace rs::shape_coding
