#include "engine/model/clock/simulator.hpp"

#include <utility>

namespace rs::engine::model {
namespace {

void shuffle(std::vector<Block*>& blocks, std::uint64_t& random) {
    for (std::size_t n = blocks.size(); n > 1; --n) {
        random = random * 6364136223846793005U + 1442695040888963407U;
        std::swap(blocks[n - 1], blocks[(random >> 33U) % n]);
    }
}

template <class F>
void dump_fifo(const F& fifo, std::string& out) {
    out += "  " + fifo.name() + ": " + std::to_string(fifo.count()) + " of " + std::to_string(fifo.depth());
    for (int i = 0; i < fifo.count(); ++i) out += (i == 0 ? "  " : " | ") + fifo.item_text(i);
    out += '\n';
}

}  // namespace

Simulator::Simulator(const Options& options) : options_(options), random_(options.shuffle_seed) {
    RS_CHECK(options.board_period > 0 && options.pci_period > 0);
}

void Simulator::add(Domain domain, Block& block) {
    (domain == Domain::board ? board_ : pci_).blocks.push_back(&block);
}

void Simulator::add(Domain domain, FifoState& fifo) {
    (domain == Domain::board ? board_ : pci_).fifos.push_back(&fifo);
}

void Simulator::add(Domain domain, const FifoGroup& group) {
    for (FifoState* const fifo : group.fifos()) add(domain, *fifo);
}

void Simulator::add_crossing(Domain writer, CrossingState& fifo) {
    (writer == Domain::board ? board_ : pci_).written.push_back(&fifo);
    (writer == Domain::board ? pci_ : board_).read.push_back(&fifo);
}

bool Simulator::clock(DomainParts& parts, std::uint64_t now) {
    if (options_.shuffle_seed != 0) shuffle(parts.blocks, random_);
    bool progress = false;
    for (Block* block : parts.blocks) {
        block->clock(now);
        progress |= is_progress(block->last_activity());
    }
    for (FifoState* fifo : parts.fifos) progress |= fifo->commit();
    for (CrossingState* fifo : parts.written) progress |= fifo->commit_writer();
    for (CrossingState* fifo : parts.read) progress |= fifo->commit_reader();
    return progress;
}

void Simulator::step() {
    bool progress = clock(board_, board_cycles_++);
    phase_ += options_.board_period;
    while (phase_ >= options_.pci_period) {
        phase_ -= options_.pci_period;
        progress |= clock(pci_, pci_cycles_++);
    }
    quiet_cycles_ = progress ? 0 : quiet_cycles_ + 1;
    if (observer_) observer_(board_cycles_);
}

Status Simulator::run_until(const std::function<bool()>& done, std::uint64_t max_cycles) {
    quiet_cycles_ = 0;
    for (std::uint64_t n = 0; !done(); ++n) {
        if (n == max_cycles) {
            return Error{"the board is not done after " + std::to_string(max_cycles) + " cycles; its state:\n" +
                         dump()};
        }
        if (quiet_cycles_ >= options_.no_progress_cycles) {
            return Error{"the board made no progress for " + std::to_string(quiet_cycles_) + " cycles (now at cycle " +
                         std::to_string(board_cycles_) + "); its state:\n" + dump()};
        }
        step();
    }
    return {};
}

std::string Simulator::dump() const {
    std::string out;
    for (const DomainParts* parts : {&board_, &pci_}) {
        for (const FifoState* fifo : parts->fifos) dump_fifo(*fifo, out);
        for (const CrossingState* fifo : parts->written) dump_fifo(*fifo, out);
        for (const Block* block : parts->blocks) {
            out += "  [" + block->name() + "] " + std::string(activity_name(block->last_activity())) + " " +
                   block->state_text() + '\n';
        }
    }
    return out;
}

}  // namespace rs::engine::model
