#pragma once
// Block decompression: from a column's walk to its samples, out of pictures of profile `board`. Constructs FIFOs and
// blocks and wires them, a chain of readers for each hop of a prediction:
//
//     block_scan --asks_0--> [tile_finder -> tile_reader -> record_reader -> block_motion]_0 --asks_1--> [..]_1 -> ..
//          |                                                              | records_0
//          +-------------------------- pixels_0 ------------------> [record_select]_0 --pixels_1--> [..]_1 -> ..
//          book_lookup
//
// Asks run ahead of their pixels, so that several blocks are under way in every chain. No chain waits for a later one:
// what a later hop needs has been asked for when the record that leads there can be taken.

#include "engine/model/blocks/decompression/block_motion.hpp"
#include "engine/model/blocks/decompression/block_scan.hpp"
#include "engine/model/blocks/decompression/book_lookup.hpp"
#include "engine/model/blocks/decompression/record_reader.hpp"
#include "engine/model/blocks/decompression/record_select.hpp"
#include "engine/model/blocks/decompression/tile_finder.hpp"
#include "engine/model/blocks/decompression/tile_reader.hpp"
#include "engine/model/blocks/memory/memory_controller.hpp"
#include "engine/model/clock/simulator.hpp"

#include <memory>
#include <vector>

namespace rs::engine::model {

struct HopFifos {
    explicit HopFifos(int hop, const std::string& suffix);
    Fifo<BlockAsk> asks;
    Fifo<MemoryRead> table_reads;
    Fifo<MemoryWord> table_words;
    Fifo<FoundTile> found;
    Fifo<MemoryRead> tile_reads;
    Fifo<MemoryWord> tile_words;
    Fifo<AskedTile> tiles;
    Fifo<MemoryRead> record_reads;
    Fifo<MemoryWord> record_words;
    Fifo<AskedRecord> asked_records;
    Fifo<BlockRecord> records;
    Fifo<CodedPixel> pixels;
};

struct HopBlocks {
    HopBlocks(int hop, const RegisterFile& registers, HopFifos& fifos, Fifo<BlockAsk>* next_asks,
              Fifo<CodedPixel>& next_pixels);
    TileFinder tile_finder;
    TileReader tile_reader;
    RecordReader record_reader;
    BlockMotion block_motion;
    RecordSelect record_select;
};

// The chains of all hops: asks and pixels go into those of hop 0, pixels with all their records come out of `complete`.
struct RecordChains {
    // `suffix` is appended to the names of FIFOs and blocks.
    explicit RecordChains(const RegisterFile& registers, const std::string& suffix = "");
    void add_chains_to(Simulator& simulator);
    // The memory ports in order of service: the last hop first, for others wait for it; of a hop, records first, which
    // stand in the row of the record before.
    void add_chain_ports(std::vector<ReadPort>& ports);

    std::vector<std::unique_ptr<HopFifos>> fifos;  // [hop]
    Fifo<CodedPixel> complete;
    std::vector<std::unique_ptr<HopBlocks>> hops;  // [hop]
};

struct BlockDecompression : RecordChains {
    BlockDecompression(const RegisterFile& registers, Fifo<ColumnWalk>& walks, Fifo<YuvaPixel>& samples);
    void add_to(Simulator& simulator);
    void add_ports(std::vector<ReadPort>& ports);

    Fifo<MemoryRead> book_reads{"book_reads", 8, MemoryRead::kBits};
    Fifo<MemoryWord> book_words{"book_words", 16, MemoryWord::kBits};
    BlockScan block_scan;
    BookLookup book_lookup;
};

}  // namespace rs::engine::model
