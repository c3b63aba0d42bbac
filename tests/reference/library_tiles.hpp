#pragma once
// The library's decoder, asked tile by tile.

#include "rayspace/codec/code/coded_pictures.hpp"
#include "rayspace/image/image.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace rs::reference {

using LibraryPlanes = std::array<Image<std::uint8_t>, 4>;  // Y, U, V, alpha of the coded size

// Every tile of every picture by decode_tile(), into planes that hold something else before. All pictures are loaded.
[[nodiscard]] std::vector<LibraryPlanes> decode_by_tiles(const codec::CodedPictures& coded);

}  // namespace rs::reference
