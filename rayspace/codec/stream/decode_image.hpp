#pragma once
// Decodes tiles and whole images.

#include "rayspace/codec/code/coded_images.hpp"
#include "rayspace/codec/dense_tile.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace rs::codec {

/// The rectangle of tile number `tile` (row by row) of every image.
TileRect tile_rect(const CodedImages& coded, std::size_t tile);

/// Decodes a tile of image `view`, which must be loaded, and writes only the tile's samples of `out`. Thread-safe.
/// \param references  samples of the images coded.images[view].head.reference, decoded at least in the rectangles
///     announced to `listener`.
/// \param listener    may be null.
void decode_tile(const CodedImages& coded, std::size_t view, std::size_t tile,
                 const std::array<ConstPlaneViews, 2>& references, ReferenceListener* listener, const PlaneViews& out);

/// Decodes every loaded image by decode(view, tile, references, out) for each of its tiles: each image after its
/// references, otherwise on the threads of the calling tbb arena in any order.
using DecodeTile = std::function<void(std::size_t view, std::size_t tile,
                                      const std::array<ConstPlaneViews, 2>& references, const PlaneViews& out)>;
std::vector<Planes> decode_planes(const CodedImages& coded, const DecodeTile& decode);

/// Decodes every loaded image of *object.coded into object.images (with chroma at full size), on the threads of the
/// calling tbb arena. Memory: 4 bytes per pixel. Images are loaded together with their references (object_file.hpp).
void decode_images(RaySpaceObject& object);

}  // namespace rs::codec
