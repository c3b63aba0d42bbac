#include "engine/model/block_decompression.hpp"

#include <string>

namespace rs::engine::model {
namespace {

// The encoder predicts over one hop; the chains behind it are as long as they must be for records to come.
constexpr bool is_common(int hop) {
    return hop < 2;
}

std::string of_hop(const char* name, int hop) {
    return std::string(name) + "_" + std::to_string(hop);
}

std::vector<std::unique_ptr<HopFifos>> all_fifos(const std::string& suffix) {
    std::vector<std::unique_ptr<HopFifos>> all;
    for (int hop = 0; hop < kHops; ++hop) all.push_back(std::make_unique<HopFifos>(hop, suffix));
    return all;
}

std::vector<std::unique_ptr<HopBlocks>> all_blocks(const RegisterFile& registers,
                                                   const std::vector<std::unique_ptr<HopFifos>>& fifos,
                                                   Fifo<CodedPixel>& complete) {
    std::vector<std::unique_ptr<HopBlocks>> all;
    for (std::size_t hop = 0; hop < fifos.size(); ++hop) {
        const bool last = hop + 1 == fifos.size();
        all.push_back(std::make_unique<HopBlocks>(static_cast<int>(hop), registers, *fifos[hop],
                                                  last ? nullptr : &fifos[hop + 1]->asks,
                                                  last ? complete : fifos[hop + 1]->pixels));
    }
    return all;
}

std::array<Block*, 5> blocks_of(HopBlocks& b) {
    return {&b.tile_finder, &b.tile_reader, &b.record_reader, &b.block_motion, &b.record_select};
}

}  // namespace

HopFifos::HopFifos(int hop, const std::string& suffix)
    : asks(of_hop("asks", hop) + suffix, is_common(hop) ? 8 : 4, BlockAsk::kBits),
      table_reads(of_hop("table_reads", hop) + suffix, 2, MemoryRead::kBits),
      table_words(of_hop("table_words", hop) + suffix, is_common(hop) ? 8 : 2, MemoryWord::kBits),
      found(of_hop("found", hop) + suffix, is_common(hop) ? 8 : 2, FoundTile::kBits),
      tile_reads(of_hop("tile_reads", hop) + suffix, 2, MemoryRead::kBits),
      tile_words(of_hop("tile_words", hop) + suffix, is_common(hop) ? 8 : 2, MemoryWord::kBits),
      tiles(of_hop("tiles", hop) + suffix, is_common(hop) ? 8 : 2, AskedTile::kBits),
      record_reads(of_hop("record_reads", hop) + suffix, 4, MemoryRead::kBits),
      record_words(of_hop("record_words", hop) + suffix, is_common(hop) ? 16 : 4, MemoryWord::kBits),
      asked_records(of_hop("asked_records", hop) + suffix, is_common(hop) ? 8 : 2, AskedRecord::kBits),
      records(of_hop("records", hop) + suffix, is_common(hop) ? 8 : 4, BlockRecord::kBits),
      pixels(of_hop("pixels", hop) + suffix,
             hop == 0   ? 128
             : hop == 1 ? 64
                        : 4,
             CodedPixel::bits(hop)) {}

HopBlocks::HopBlocks(int hop, const RegisterFile& registers, HopFifos& f, Fifo<BlockAsk>* next_asks,
                     Fifo<CodedPixel>& next_pixels)
    : tile_finder(hop, registers, f.asks, f.table_reads, f.found),
      tile_reader(hop, f.found, f.table_words, f.tile_reads, f.tiles),
      record_reader(hop, registers, f.tiles, f.tile_words, f.record_reads, f.asked_records),
      block_motion(hop, registers, f.asked_records, f.record_words, f.records, next_asks),
      record_select(hop, registers, f.pixels, f.records, next_pixels) {}

RecordChains::RecordChains(const RegisterFile& registers, const std::string& suffix)
    : fifos(all_fifos(suffix)),
      complete("complete" + suffix, 4, CodedPixel::bits(kHops)),
      hops(all_blocks(registers, fifos, complete)) {
    for (const auto& hop : hops) {
        for (Block* block : blocks_of(*hop)) block->append_to_name(suffix);
    }
}

void RecordChains::add_chains_to(Simulator& simulator) {
    for (std::size_t hop = 0; hop < hops.size(); ++hop) {
        for (Block* block : blocks_of(*hops[hop])) simulator.add(Domain::board, *block);
        HopFifos& f = *fifos[hop];
        for (FifoState* fifo : std::initializer_list<FifoState*>{
                 &f.asks, &f.table_reads, &f.table_words, &f.found, &f.tile_reads, &f.tile_words, &f.tiles,
                 &f.record_reads, &f.record_words, &f.asked_records, &f.records, &f.pixels}) {
            simulator.add(Domain::board, *fifo);
        }
    }
}

void RecordChains::add_chain_ports(std::vector<ReadPort>& ports) {
    for (std::size_t n = fifos.size(); n-- > 0;) {
        HopFifos& f = *fifos[n];
        const int hop = static_cast<int>(n);
        ports.push_back({of_hop("record_reader", hop), &f.record_reads, &f.record_words});
        ports.push_back({of_hop("tile_reader", hop), &f.tile_reads, &f.tile_words});
        ports.push_back({of_hop("tile_finder", hop), &f.table_reads, &f.table_words});
    }
}

BlockDecompression::BlockDecompression(const RegisterFile& registers, Fifo<ColumnWalk>& walks, Fifo<YuvaPixel>& samples)
    : RecordChains(registers),
      block_scan(registers, walks, fifos[0]->asks, fifos[0]->pixels),
      book_lookup(registers, complete, book_reads, book_words, samples) {}

void BlockDecompression::add_to(Simulator& simulator) {
    simulator.add(Domain::board, block_scan);
    add_chains_to(simulator);
    simulator.add(Domain::board, book_lookup);
    for (FifoState* fifo : std::initializer_list<FifoState*>{&complete, &book_reads, &book_words}) {
        simulator.add(Domain::board, *fifo);
    }
}

void BlockDecompression::add_ports(std::vector<ReadPort>& ports) {
    ports.push_back({"book_lookup", &book_reads, &book_words});
    add_chain_ports(ports);
}

}  // namespace rs::engine::model
