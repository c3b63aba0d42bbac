#pragma once
// Runs the library's decoder tile by tile.

#include "rayspace/codec/code/coded_images.hpp"
#include "rayspace/image/image.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace rs::reference {

using LibraryPlanes = std::array<Image<std::uint8_t>, 4>;  // Y, U, V, alpha of the coded size

/// Decodes every tile of every image by decode_tile(), into planes with other contents before. All images are loaded.
[[nodiscard]] std::vector<LibraryPlanes> decode_by_tiles(const codec::CodedImages& coded);

}  // namespace rs::reference
