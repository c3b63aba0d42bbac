#include "engine/model/clock/crossing_fifo.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <Vcrossing_fifo.h>
#include <Vcrossing_fifo_mutants.h>

namespace rs::engine::rtl {
namespace {

// RTL and model on two clocks of random periods, whose edges never coincide.
template <class Module>
class Crossing {
public:
    Crossing(Module& module, Random& random) : module_(module), random_(random) {
        module.in_rst = module.out_rst = 1;
        for (int n = 0; n < 4; ++n) {
            edge(module.in_clk);
            edge(module.out_clk);
        }
        module.in_rst = module.out_rst = 0;
    }

    std::string run(int edges) {
        const std::int64_t in_period = random_.in(1, 12);
        const std::int64_t out_period = random_.in(1, 12);
        std::int64_t phase = 0;
        for (int n = 0; n < edges; ++n) {
            const bool writes = phase <= 0;
            phase += writes ? out_period : -in_period;
            const std::string difference = writes ? write() : read();
            if (!difference.empty()) return "edge " + std::to_string(n) + ": " + difference;
        }
        return {};
    }

private:
    void edge(CData& clock) {
        clock = 1;
        module_.eval();
        clock = 0;
        module_.eval();
    }
    std::string write() {
        const bool wants = in_pace_.acts(random_);
        const Bits word = random_bits(random_);
        module_.in_valid = wants;
        write_port(module_.in_data, word, 64);
        module_.eval();
        if ((module_.in_ready != 0) != fifo_.can_push()) return "ready differs";
        if (wants && fifo_.can_push()) fifo_.push({std::uint64_t{word.words[1]} << 32U | word.words[0]});
        fifo_.commit_writer();
        edge(module_.in_clk);
        return {};
    }
    std::string read() {
        const bool wants = out_pace_.acts(random_);
        module_.out_ready = wants;
        module_.eval();
        if ((module_.out_valid != 0) != fifo_.can_pop()) return "valid differs";
        if (module_.out_count != fifo_.visible()) return "count differs";
        if (fifo_.can_pop() && read_port(module_.out_data, 64) != pack(fifo_.front())) return "data differ";
        if (wants && fifo_.can_pop()) fifo_.pop();
        fifo_.commit_reader();
        edge(module_.out_clk);
        return {};
    }

    Module& module_;
    Random& random_;
    Pace in_pace_;
    Pace out_pace_;
    model::CrossingFifo<model::MemoryWord> fifo_{"crossing", 4, 64};
};

template <class Module>
std::string cross(int edges, int mutant) {
    Random random(3);
    VerilatedContext context;
    context.randReset(2);
    Module module(&context);
    if constexpr (requires { module.mutant; }) module.mutant = static_cast<CData>(mutant);
    for (int episode = 0; episode < edges / 1000; ++episode) {
        const std::string difference = Crossing<Module>(module, random).run(1000);
        if (!difference.empty()) return "episode " + std::to_string(episode) + ": " + difference;
    }
    return {};
}

TEST(RtlCrossingFifo, EqualsTheModel) {
    EXPECT_EQ(cross<Vcrossing_fifo>(200'000, 0), "");
}

TEST(RtlCrossingFifo, MutantsDifferFromTheModel) {
    EXPECT_EQ(cross<Vcrossing_fifo_mutants>(40'000, 0), "");
    VerilatedContext context;
    Vcrossing_fifo_mutants module(&context);
    module.eval();
    EXPECT_GE(module.mutants, kLeastMutants);
    for (int n = 1; n <= module.mutants; ++n) {
        EXPECT_NE(cross<Vcrossing_fifo_mutants>(40'000, n), "") << "mutant " << n << " is not noticed";
    }
}

}  // namespace
}  // namespace rs::engine::rtl
