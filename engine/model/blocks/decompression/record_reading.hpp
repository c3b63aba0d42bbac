#pragma once
// Tile finder of a hop: requests the tile table's word of a block's tile, unless it is the tile of the previous block:
// four blocks of a column share a tile. The entry's address takes two products of few bits (7 x 5 and 11 x 5).

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/coded_messages.hpp"
#include "engine/model/signals/registers.hpp"

namespace rs::engine::model {

class TileFinder final : public Block {
public:
    struct Ports {
        Fifo<BlockRequest>& in;
        Fifo<MemoryRead>& requests;
        Fifo<FoundTile>& out;
    };
    TileFinder(int hop, const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;

private:
    const RegisterFile& registers_;
    Fifo<BlockRequest>& in_;
    Fifo<MemoryRead>& requests_;
    Fifo<FoundTile>& out_;
    int last_entry_ = -1;  // table entry of the previous request
};

// Tile reader of a hop: takes the tile's address from the table's word and requests the tile's first word, with its
// classes and references. Blocks of the previous tile and empty tiles pass without a request.

class TileReader final : public Block {
public:
    struct Ports {
        Fifo<FoundTile>& in;
        Fifo<MemoryWord>& entries;
        Fifo<MemoryRead>& requests;
        Fifo<RequestedTile>& out;
    };
    TileReader(int hop, const Ports& ports);
    Activity tick(std::uint64_t now) override;

private:
    Fifo<FoundTile>& in_;
    Fifo<MemoryWord>& entries_;
    Fifo<MemoryRead>& requests_;
    Fifo<RequestedTile>& out_;
};

// Record reader of a hop: stores the first word of the tile, locates a block's record, and requests its words. The
// record follows those of the blocks before it: the sizes of up to 15 classes are summed by a tree of adders in one
// cycle (15 look-ups in 8 sizes of 4 bits, four levels of additions of at most 8 bits, and the address).

class RecordReader final : public Block {
public:
    struct Ports {
        Fifo<RequestedTile>& in;
        Fifo<MemoryWord>& heads;
        Fifo<MemoryRead>& requests;
        Fifo<RequestedRecord>& out;
    };
    RecordReader(int hop, const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override { return "words to request " + std::to_string(to_request_); }

private:
    const RegisterFile& registers_;
    Fifo<RequestedTile>& in_;
    Fifo<MemoryWord>& heads_;
    Fifo<MemoryRead>& requests_;
    Fifo<RequestedRecord>& out_;
    bool loaded_ = false;     // the new tile's word has been taken
    std::uint64_t head_ = 0;  // 0: no tile
    WordAddress tile_ = 0;
    int to_request_ = 0;  // words of the record
    WordAddress next_ = 0;
};

}  // namespace rs::engine::model
