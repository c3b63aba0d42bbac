#pragma once
// The decoder of one tile of a board image: encode/FORMAT.md, section "Board tiles". Integer and normative; engine
// and tools share it. It needs no more than look-ups and additions, so that hardware can do the same for one pixel per
// cycle.

#include "rayspace/codec/code/board_code.hpp"
#include "rayspace/codec/dense_tile.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rs::codec {

inline constexpr int kBoardBlock = 8;          // side of a block
inline constexpr int kBoardTileBlocks = 16;    // of a tile, column by column
inline constexpr int kBoardTileHeadBytes = 6;  // 3 bits for each block's class

// The 16 classes of a tile, block b at bit 3 b. Bytes behind the end count as zero, here and below.
std::uint64_t board_tile_classes(std::span<const std::byte> bytes);

// Where a predicted record points to.
struct BoardMotion {
    int reference = 0;  // 0 or 1
    int x = 0;          // whole samples, -128 .. 127
    int y = 0;          // -64 .. 63
};
BoardMotion board_motion(std::uint16_t word);
std::uint16_t board_motion_word(const BoardMotion& motion);  // its inverse

// As decode_dense_tile(): any bytes give some samples. Where an image has one reference, `reference` is taken as 0.
// Cost: some 0.2 microseconds for 64 samples of each plane.
void decode_board_tile(const BoardCode& code, const ImageHead& head, std::span<const std::byte> bytes,
                       const TilePlace& place, const std::array<ConstPlaneViews, 2>& references,
                       ReferenceListener* listener, const PlaneViews& out);

// The samples of one block from its record, at (x, y) of the image.
void decode_board_block(const BoardCode& code, const RecordClass& record_class, std::span<const std::byte> record,
                        int x, int y, int reference_count, const std::array<ConstPlaneViews, 2>& references,
                        ReferenceListener* listener, const PlaneViews& out);

}  // namespace rs::codec
