#pragma once
// A block alone on a clock, with its FIFOs.

#include "engine/model/clock/block.hpp"
#include "engine/model/clock/fifo.hpp"

#include <initializer_list>
#include <utility>
#include <vector>

namespace rs::engine::model::test {

// What stands in the FIFO before the first cycle.
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
    // Steps until `out` holds one more item, and says how many steps that took: in the cycle before, it was not
    // visible. -1: not within `most`.
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
