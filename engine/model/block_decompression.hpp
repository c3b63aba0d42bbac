#pragma once
// Block decompression: computes the samples of a column's walk from images of profile `board`. Constructs and wires
// FIFOs and blocks, with a chain of readers for each hop of a prediction:
//
//     block_scan --asks_0--> [tile_finder -> tile_reader -> record_reader -> block_motion]_0 --asks_1--> [..]_1 -> ..
//          |                                                              | records_0
//          +-------------------------- pixels_0 ------------------> [record_select]_0 --pixels_1--> [..]_1 -> ..
//          book_lookup
//
// Requests run ahead of their pixels, so that several blocks are in flight in every chain. No chain waits for a later
// one: data of a later hop are requested before the record that refers to it can be taken.

#include "engine/model/blocks/decompression/block_motion.hpp"
#include "engine/model/blocks/decompression/block_scan.hpp"
#include "engine/model/blocks/decompression/book_lookup.hpp"
#include "engine/model/blocks/decompression/record_reading.hpp"
#include "engine/model/blocks/decompression/record_select.hpp"
#include "engine/model/blocks/memory/memory_controller.hpp"
#include "engine/model/clock/simulator.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace rs::engine::model {

struct HopFifos : FifoGroup {
    HopFifos(int hop, const std::string& suffix)
        : FifoGroup("_" + std::to_string(hop) + suffix), depth(is_common(hop) ? 8 : 2), hop_index(hop) {}
    // The encoder predicts over one hop; chains of later hops have the minimum depth.
    static constexpr bool is_common(int hop) { return hop < 2; }

    const int depth;
    const int hop_index;
    Fifo<BlockRequest> asks{*this, "asks", std::max(depth, 4), BlockRequest::kBits};
    Fifo<MemoryRead> table_reads{*this, "table_reads", 2, MemoryRead::kBits};
    Fifo<MemoryWord> table_words{*this, "table_words", depth, MemoryWord::kBits};
    Fifo<FoundTile> found{*this, "found", depth, FoundTile::kBits};
    Fifo<MemoryRead> tile_reads{*this, "tile_reads", 2, MemoryRead::kBits};
    Fifo<MemoryWord> tile_words{*this, "tile_words", depth, MemoryWord::kBits};
    Fifo<RequestedTile> tiles{*this, "tiles", depth, RequestedTile::kBits};
    Fifo<MemoryRead> record_reads{*this, "record_reads", 4, MemoryRead::kBits};
    Fifo<MemoryWord> record_words{*this, "record_words", is_common(hop_index) ? 16 : 4, MemoryWord::kBits};
    Fifo<RequestedRecord> asked_records{*this, "asked_records", depth, RequestedRecord::kBits};
    Fifo<BlockRecord> records{*this, "records", std::max(depth, 4), BlockRecord::kBits};
    Fifo<CodedPixel> pixels{*this, "pixels", is_common(hop_index) ? 128 >> hop_index : 4, CodedPixel::bits(hop_index)};
};

struct HopBlocks {
    HopBlocks(int hop, const RegisterFile& registers, HopFifos& fifos, Fifo<BlockRequest>* next_asks,
              Fifo<CodedPixel>& next_pixels);
    TileFinder tile_finder;
    TileReader tile_reader;
    RecordReader record_reader;
    BlockMotion block_motion;
    RecordSelect record_select;
};

// Chains of all hops: requests and pixels enter at hop 0, pixels with all their records leave through `complete`.
struct RecordChains : FifoGroup {
    // `suffix` is appended to the names of FIFOs and blocks.
    explicit RecordChains(const RegisterFile& registers, const std::string& suffix = "");
    void add_to(Simulator& simulator);
    // Memory ports in order of service: the last hop first, because the others wait for it; within a hop records first,
    // which are in the same row as the previous record.
    void add_chain_ports(std::vector<ReadPort>& ports);

    std::vector<std::unique_ptr<HopFifos>> hop_fifos;  // [hop]
    Fifo<CodedPixel> complete{*this, "complete", 4, CodedPixel::bits(kHops)};
    std::vector<std::unique_ptr<HopBlocks>> hops;  // [hop]
};

struct BlockDecompression : RecordChains {
    static constexpr int kSampleBits = YuvaPixel::kBitsOfCoded;
    BlockDecompression(const RegisterFile& registers, Fifo<ColumnWalk>& walks, Fifo<YuvaPixel>& samples);
    void add_to(Simulator& simulator);
    void add_ports(std::vector<ReadPort>& ports);

    Fifo<MemoryRead> book_reads{*this, "book_reads", 8, MemoryRead::kBits};
    Fifo<MemoryWord> book_words{*this, "book_words", 16, MemoryWord::kBits};
    BlockScan block_scan;
    BookLookup book_lookup;
};

}  // namespace rs::engine::model
