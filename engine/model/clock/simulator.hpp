#pragma once
// Ticks blocks and commits FIFOs, cycle by cycle, in two clock domains whose periods have an integer ratio. Either
// clock may be the faster one. Edge n of the board is at n periods of the board; edge k of the bus is just before k + 1
// periods of the bus. So edges never coincide, and both clocks are ticked in the order of time.
//
// If no FIFO moves and no block works for a given number of board cycles before the run is done, the run fails with the
// contents of every FIFO and the state of every block.

#include "engine/model/clock/block.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace rs::engine::model {

enum class Domain { board, pci };

class Simulator {
public:
    struct Options {
        int board_period = 5;  // in units common to both clocks, 5 ns at 200 MHz: 5 units for 40 MHz, 6 for 33.3 MHz
        int pci_period = 6;
        std::uint64_t no_progress_cycles = 20000;  // of the board's clock
        std::uint64_t shuffle_seed = 0;            // not 0: blocks are ticked in a new random order every cycle
    };
    explicit Simulator(const Options& options);

    void add(Domain domain, Block& block);
    void add(Domain domain, FifoState& fifo);
    void add(Domain domain, const FifoGroup& group);
    void add_crossing(Domain writer, CrossingState& fifo);

    // Executes one edge of the board's clock and the edges of the bus clock before the board's next one.
    void step();

    // Steps until done() returns true. Fails after no_progress_cycles without progress, or after `max_cycles`.
    Status run_until(const std::function<bool()>& done, std::uint64_t max_cycles);

    [[nodiscard]] std::uint64_t board_cycles() const { return board_cycles_; }
    [[nodiscard]] std::uint64_t pci_cycles() const { return pci_cycles_; }
    [[nodiscard]] std::string dump() const;

    struct DomainParts {
        std::vector<Block*> blocks;
        std::vector<FifoState*> fifos;
        std::vector<CrossingState*> written;  // crossing FIFOs that are written, and read, in this domain
        std::vector<CrossingState*> read;
    };
    [[nodiscard]] const DomainParts& parts(Domain domain) const { return domain == Domain::board ? board_ : pci_; }

    // Called after every board cycle; for waveforms.
    void observe(std::function<void(std::uint64_t)> observer) { observer_ = std::move(observer); }

private:
    bool clock(DomainParts& parts, std::uint64_t now);

    Options options_;
    DomainParts board_;
    DomainParts pci_;
    std::uint64_t board_cycles_ = 0;
    std::uint64_t pci_cycles_ = 0;
    std::uint64_t quiet_cycles_ = 0;
    int phase_ = 0;  // units since the end of the last bus period, at the board's next edge
    std::uint64_t random_;
    std::function<void(std::uint64_t)> observer_;
};

}  // namespace rs::engine::model
