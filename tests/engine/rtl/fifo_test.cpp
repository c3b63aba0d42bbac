#include "engine/model/clock/fifo.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vfifo.h>
#include <Vfifo_mutants.h>

namespace rs::engine::rtl {
namespace {

// The FIFO of the model takes the place of a block: it takes an item from `source` and gives it to `sink` by the rules
// of the RTL FIFO, in which an item rests for one cycle.
class FifoBlock final : public model::Block {
public:
    FifoBlock(model::Fifo<model::MemoryWord>& in, model::Fifo<model::MemoryWord>& out)
        : Block("fifo", "a word per cycle"), in_(reads(in)), out_(writes(out)) {}
    model::Activity tick(std::uint64_t /*now*/) override {
        if (places_.can_pop() && out_.can_push()) out_.push(places_.pop());
        if (in_.can_pop() && places_.can_push()) places_.push(in_.pop());
        places_.commit();
        return model::Activity::busy;
    }

private:
    model::Fifo<model::MemoryWord>& in_;
    model::Fifo<model::MemoryWord>& out_;
    model::Fifo<model::MemoryWord> places_{"places", 4, 64};
};

template <class Module>
class FifoBench final : public Bench<Module> {
public:
    FifoBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(in_, RS_RTL_PORTS(module, in), [this] { return model::MemoryWord{this->random_.word()}; });
        this->output(out_, RS_RTL_PORTS(module, out));
    }

private:
    model::Block& block() override { return block_; }

    model::Fifo<model::MemoryWord> in_{"in", 2, 64};
    model::Fifo<model::MemoryWord> out_{"out", 2, 64};
    FifoBlock block_{in_, out_};
};

RS_RTL_TESTS(RtlFifo, FifoBench, fifo)

}  // namespace
}  // namespace rs::engine::rtl
