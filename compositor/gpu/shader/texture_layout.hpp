#pragma once
// Layout of the textures of an object for the reconstruction shader (reconstruction_shader.hpp): the cells of its shape
// maps, sizes and limits.
//
// A texel of cells holds the cells of two neighbouring bands. A column of `bands` cells is stored as bands + 2 pairs:
// pair n holds bands n - 1 and n, of which those outside of the map are empty, and the last pair is empty.

#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace rs::compositor {

/// Depth and `shown` of two neighbouring bands.
using CellPair = std::array<std::uint8_t, 4>;

/// Pairs of a shape map, padded to full rows of kCellTextureWidth; one row of empty pairs without cells.
std::vector<CellPair> cell_pairs(const ShapeMap& shape);

/// Rows of the texture of cell_pairs().
std::int64_t cell_texture_rows(const ShapeMap& shape);

/// GPU memory of an object with `photos` photos in textures, as RGBA with their details, and its cells.
std::int64_t gpu_bytes(const RaySpaceObject& object, int photos);

/// Success if the textures of the object, with `photos` photos, are within the limits, else an error that names the
/// object. \param max_side    largest width and height of a texture \param max_layers  most layers of an array
Status check_texture_limits(const RaySpaceObject& object, int photos, int max_side, int max_layers);

}  // namespace rs::compositor
