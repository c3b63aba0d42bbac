#pragma once
// Decoder of one tile of a board image: encode/FORMAT.md, section "Board tiles". Integer and normative; shared by
// engine and tools. It needs only table look-ups and additions, so that hardware can decode one pixel per cycle.

#include "rayspace/codec/code/board_code.hpp"
#include "rayspace/codec/dense_tile.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rs::codec {

inline constexpr int kBoardBlock = 8;          // side of a block
inline constexpr int kBoardTileBlocks = 16;    // blocks per tile, column by column
inline constexpr int kBoardTileHeadBytes = 6;  // 3 bits per block's class

/// The 16 classes of a tile, block b at bit 3 b. Bytes beyond the end count as zero, also in the functions below.
std::uint64_t board_tile_classes(std::span<const std::byte> bytes);

/// Motion of a predicted record.
struct BoardMotion {
    int reference = 0;  // 0 or 1
    int x = 0;          // whole samples, -128 .. 127
    int y = 0;          // -64 .. 63
};
BoardMotion board_motion(std::uint16_t word);
std::uint16_t board_motion_word(const BoardMotion& motion);  // its inverse

/// Decodes a tile as decode_dense_tile() does; any bytes decode to some samples. In an image with one reference, each
/// record's `reference` counts as 0. Cost: about 0.2 microseconds per 64 samples of each plane.
void decode_board_tile(const BoardCode& code, const CodedTile& tile, const PlaneViews& out);

}  // namespace rs::codec
