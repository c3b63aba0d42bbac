#pragma once
// Board profile part of chunk CODE: record classes and codebooks. encode/FORMAT.md, section "CODE".

#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/codec/code/board_code.hpp"

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

}  // namespace rs::codec
