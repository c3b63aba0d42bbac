#pragma once
// The part of chunk CODE that is the board profile's: record classes and codebooks. encode/FORMAT.md, section "CODE".

#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/codec/code/board_code.hpp"

namespace rs::codec {

// The books must have the sizes that the classes need.
void put_board_code(const BoardCode& code, ByteWriter& out);

// To the end of the payload. Memory: at most 270 KB, whatever the bytes are.
Status take_board_code(ByteReader& in, BoardCode& code);

// How many block and quarter stages the records of a kind (0: flat, 1: predicted) use at most, of all classes.
struct StageCounts {
    int block = 0;
    int quarter = 0;
};
StageCounts stage_counts(const BoardCode& code, std::size_t kind);
bool uses_alpha(const BoardCode& code);

}  // namespace rs::codec
