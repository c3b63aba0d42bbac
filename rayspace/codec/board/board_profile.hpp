#pragma once
// Board profile of coded images: its part of chunk CODE, with record classes and codebooks (board_chunk.cpp;
// encode/FORMAT.md, section "CODE"), and the decoder of a tile (board_tile.cpp; section "Board tiles"). The decoder is
// integer and normative, and shared by engine and tools. It needs only table look-ups and additions, so that hardware
// can decode one pixel per cycle.

#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/codec/code/board_code.hpp"
#include "rayspace/codec/dense_tile.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rs::codec {

/// Writes the code. The books must have the sizes required by the classes.
void put_board_code(const BoardCode& code, ByteWriter& out);

/// Reads to the end of the payload. Memory: at most 270 KB for any input.
Status take_board_code(ByteReader& in, BoardCode& code);

/// The largest number of block and quarter stages of any record class of a kind (0: flat, 1: predicted).
struct StageCounts {
    int block = 0;
    int quarter = 0;
};
StageCounts stage_counts(const BoardCode& code, std::size_t kind);
bool uses_alpha(const BoardCode& code);

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
