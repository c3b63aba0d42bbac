#pragma once
// Layout of an object in every memory channel of a parallel board; images are numbered by the places of their views in
// the ring.
//
//     RS map           a byte per cell: image, 255 without
//     image record     4 + 4 K words, of image n from n * (4 + 4 K):
//                          cx | cy << 32,  fl_y | height << 32,  S | b << 16 | first_line << 32,  0
//                                                          (of the gap behind n; b: 1 if the gap before it has
//                                                          lines, plus 2 if the gap behind it has)
//                      then for plane k:
//                          l0 | l1 << 32,  q0 | q1 << 32,  l2 | q2 << 32,  va | vc << 32
//     shape cells      four to a word, the lowest bits first: depth | shown << 8; every column (a place in p of a line)
//                      begins at a word
//     raw images       blocks of 8x8 texels, column by column, 20 words each: for each pair of texel columns
//                      their four (U, V) pairs, then Y and alpha of the left one, Y and alpha of the right one;
//                      texels outside of the image are 0
//     coded images     coded_layout.hpp

#include "rayspace/api/types/shape_map.hpp"

#include <cstdint>

namespace rs::engine::model {

inline constexpr int kRawBlockWords = 20;

// Words of a raw image of the given size in pixels.
constexpr std::uint64_t raw_image_words(int width, int height) {
    return static_cast<std::uint64_t>((width + 7) / 8) * static_cast<std::uint64_t>((height + 7) / 8) * kRawBlockWords;
}

constexpr int record_words(int planes) {
    return 4 + 4 * planes;
}
constexpr int plane_words(int plane) {
    return 4 + 4 * plane;
}

constexpr int kCellsPerWord = 4;

// Words of a column of cells.
constexpr int column_words(int bands) {
    return (bands + kCellsPerWord - 1) / kCellsPerWord;
}

// Words of all columns of a shape map.
inline std::uint64_t cell_words(const ShapeMap& shape) {
    if (shape.empty()) return 0;
    return shape.cells.size() / static_cast<std::size_t>(shape.bands) *
           static_cast<std::uint64_t>(column_words(shape.bands));
}

constexpr std::uint16_t packed_cell(const ShapeCell& cell) {
    return static_cast<std::uint16_t>(cell.depth | cell.shown << 8);
}
constexpr ShapeCell unpacked_cell(std::uint16_t bits) {
    return {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
}

// Signed 32-bit halves of a word.
constexpr std::int32_t low_half(std::uint64_t word) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(word));
}
constexpr std::int32_t high_half(std::uint64_t word) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(word >> 32U));
}

}  // namespace rs::engine::model
