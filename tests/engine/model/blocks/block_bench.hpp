#pragma once
// Test bench: a single block with its FIFOs on a clock.

#include "engine/model/clock/block.hpp"
#include "engine/model/clock/fifo.hpp"

#include <initializer_list>
#include <utility>
#include <vector>

namespace rs::engine::model::test {

// Adds an item that is visible in the next cycle.
template <class Item>
void put(Fifo<Item>& fifo, Item item) {
    fifo.push(std::move(item));
    fifo.commit();
}

class Bench {
public:
    explicit Bench(std::initializer_list<FifoState*> fifos) : fifos_(fifos) {}
    void step(Block& block) {
        block.clock(now_++);
        for (FifoState* fifo : fifos_) fifo->commit();
    }
    // Steps until `out` holds one more item; returns the number of steps, or -1 if none appears within `most` steps.
    // The item was not visible one cycle earlier.
    int cycles_until(Block& block, const FifoState& out, int most = 400) {
        const int before = out.count();
        for (int n = 1; n <= most; ++n) {
            step(block);
            if (out.count() > before) return n;
        }
        return -1;
    }

private:
    std::vector<FifoState*> fifos_;
    std::uint64_t now_ = 0;
};

}  // namespace rs::engine::model::test
