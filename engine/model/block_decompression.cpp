#include "engine/model/block_decompression.hpp"

#include <string>

namespace rs::engine::model {
namespace {

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

HopBlocks::HopBlocks(int hop, const RegisterFile& registers, HopFifos& f, Fifo<BlockRequest>* next_asks,
                     Fifo<CodedPixel>& next_pixels)
    : tile_finder(hop, registers, {.in = f.asks, .requests = f.table_reads, .out = f.found}),
      tile_reader(hop, {.in = f.found, .entries = f.table_words, .requests = f.tile_reads, .out = f.tiles}),
      record_reader(hop, registers,
                    {.in = f.tiles, .heads = f.tile_words, .requests = f.record_reads, .out = f.asked_records}),
      block_motion(hop, registers,
                   {.in = f.asked_records, .words = f.record_words, .out = f.records, .asks = next_asks}),
      record_select(hop, registers, {.in = f.pixels, .records = f.records, .out = next_pixels}) {}

RecordChains::RecordChains(const RegisterFile& registers, const std::string& suffix)
    : FifoGroup(suffix), hop_fifos(all_fifos(suffix)), hops(all_blocks(registers, hop_fifos, complete)) {
    for (const auto& hop : hops) {
        for (Block* block : blocks_of(*hop)) block->append_to_name(suffix);
    }
}

void RecordChains::add_to(Simulator& simulator) {
    for (std::size_t hop = 0; hop < hops.size(); ++hop) {
        for (Block* block : blocks_of(*hops[hop])) simulator.add(Domain::board, *block);
        simulator.add(Domain::board, *hop_fifos[hop]);
    }
    simulator.add(Domain::board, *this);
}

void RecordChains::add_chain_ports(std::vector<ReadPort>& ports) {
    for (std::size_t n = hop_fifos.size(); n-- > 0;) {
        HopFifos& f = *hop_fifos[n];
        const int hop = static_cast<int>(n);
        ports.push_back({of_hop("record_reader", hop), &f.record_reads, &f.record_words});
        ports.push_back({of_hop("tile_reader", hop), &f.tile_reads, &f.tile_words});
        ports.push_back({of_hop("tile_finder", hop), &f.table_reads, &f.table_words});
    }
}

BlockDecompression::BlockDecompression(const RegisterFile& registers, Fifo<ColumnWalk>& walks, Fifo<YuvaPixel>& samples)
    : RecordChains(registers),
      block_scan(registers, {.in = walks, .asks = hop_fifos[0]->asks, .pixels = hop_fifos[0]->pixels}),
      book_lookup(registers, {.in = complete, .requests = book_reads, .words = book_words, .out = samples}) {}

void BlockDecompression::add_to(Simulator& simulator) {
    simulator.add(Domain::board, block_scan);
    RecordChains::add_to(simulator);
    simulator.add(Domain::board, book_lookup);
}

void BlockDecompression::add_ports(std::vector<ReadPort>& ports) {
    ports.push_back({"book_lookup", &book_reads, &book_words});
    add_chain_ports(ports);
}

}  // namespace rs::engine::model
