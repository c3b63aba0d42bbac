#pragma once
// Tiles and whole images.

#include "rayspace/codec/code/coded_images.hpp"
#include "rayspace/codec/dense_tile.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace rs::codec {

// Tile number `tile` (row by row) of every image.
TilePlace place_of_tile(const CodedImages& coded, std::size_t tile);

// Decodes a tile of image `view`, which must be loaded. references[r]: the samples of the image
// coded.images[view].head.reference[r], decoded at least where `listener` (may be null) is informed that they are
// needed. Writes only the tile's samples of `out`; may be called from several threads at once.
void decode_tile(const CodedImages& coded, std::size_t view, std::size_t tile,
                 const std::array<ConstPlaneViews, 2>& references, ReferenceListener* listener, const PlaneViews& out);

// The samples of every loaded image, by decode(view, tile, references, out) for each of its tiles; an image after
// those that it is predicted from, else on the threads of the calling tbb arena in any order.
using DecodeTile = std::function<void(std::size_t view, std::size_t tile,
                                      const std::array<ConstPlaneViews, 2>& references, const PlaneViews& out)>;
std::vector<Planes> decode_planes(const CodedImages& coded, const DecodeTile& decode);

// Unpacks every loaded image: object.images (with chroma at full size) from *object.coded, on the threads of the
// calling tbb arena. Memory: 4 bytes a pixel. Images are loaded with what they are predicted from (object_file.hpp).
void decode_images(RaySpaceObject& object);

}  // namespace rs::codec
