#pragma once
// Tile reader of a hop: takes the tile's address from the table's word and asks for the tile's first word, its classes
// and references. Blocks of the tile before, and tiles that show nothing, pass.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/coded_messages.hpp"

namespace rs::engine::model {

class TileReader final : public Block {
public:
    TileReader(int hop, Fifo<FoundTile>& in, Fifo<MemoryWord>& entries, Fifo<MemoryRead>& requests,
               Fifo<AskedTile>& out);
    Activity tick(std::uint64_t now) override;

private:
    Fifo<FoundTile>& in_;
    Fifo<MemoryWord>& entries_;
    Fifo<MemoryRead>& requests_;
    Fifo<AskedTile>& out_;
};

}  // namespace rs::engine::model
