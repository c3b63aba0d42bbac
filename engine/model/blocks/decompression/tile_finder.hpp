#pragma once
// Tile finder of a hop: asks for the tile table's word of a block's tile, unless it is the tile of the block before:
// four blocks of a column share theirs. The entry's address takes two products of few bits (7 x 5 and 11 x 5).

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/coded_messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

class TileFinder final : public Block {
public:
    TileFinder(int hop, const RegisterFile& registers, Fifo<BlockAsk>& in, Fifo<MemoryRead>& requests,
               Fifo<FoundTile>& out);
    Activity tick(std::uint64_t now) override;

private:
    const RegisterFile& registers_;
    Fifo<BlockAsk>& in_;
    Fifo<MemoryRead>& requests_;
    Fifo<FoundTile>& out_;
    int last_entry_ = -1;  // of the table
};

}  // namespace rs::engine::model
