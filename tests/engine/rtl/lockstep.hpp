#pragma once
// Several connected blocks in RTL beside a board of the model: the module reads the FIFOs of the board, and in every
// cycle its ends of them must be those of the model's blocks.

#include "engine/model/board.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

#include <algorithm>

namespace rs::engine::rtl {

constexpr std::uint64_t mask(int width_bits) {
    return (std::uint64_t{1} << width_bits) - 1;
}

/// Ports of the module at a FIFO of the model that the module reads or writes.
class LockstepEnd {
public:
    virtual ~LockstepEnd() = default;
    virtual void drive(Random& random) = 0;
    virtual void sample() = 0;             // before the model's cycle, with stable outputs
    virtual std::string difference() = 0;  // after it
};

inline std::uint64_t total_popped(const model::FifoState& fifo) {
    return fifo.total_pushed() - static_cast<std::uint64_t>(fifo.count());
}

template <class T, class Data>
class LockstepInput final : public LockstepEnd {
public:
    LockstepInput(model::Fifo<T>& fifo, CData& valid, const CData& ready, Data& data)
        : fifo_(fifo), valid_(valid), ready_(ready), data_(data) {}
    void drive(Random& random) override {
        valid_ = fifo_.can_pop();
        write_port(data_, valid_ != 0 ? pack(fifo_.front(), fifo_.width_bits()) : random_bits(random),
                   fifo_.width_bits());
        popped_ = total_popped(fifo_);
    }
    void sample() override { pops_ = valid_ != 0 && ready_ != 0; }
    std::string difference() override {
        return (total_popped(fifo_) != popped_) == pops_ ? "" : fifo_.name() + ": only one of RTL and model pops";
    }

private:
    model::Fifo<T>& fifo_;
    CData& valid_;
    const CData& ready_;
    Data& data_;
    std::uint64_t popped_ = 0;
    bool pops_ = false;
};

template <class T, class Data>
class LockstepOutput final : public LockstepEnd {
public:
    LockstepOutput(model::Fifo<T>& fifo, const CData& valid, CData& ready, const Data& data)
        : fifo_(fifo), valid_(valid), ready_(ready), data_(data) {}
    void drive(Random& /*random*/) override {
        ready_ = fifo_.can_push();
        pushed_ = fifo_.total_pushed();
        popped_ = total_popped(fifo_);
        if (fifo_.can_pop()) front_ = pack(fifo_.front(), fifo_.width_bits());
    }
    void sample() override {
        pushes_ = valid_ != 0 && ready_ != 0;
        if (pushes_) sent_.push_back(read_port(data_, fifo_.width_bits()));
    }
    // A message is compared when it leaves the FIFO.
    std::string difference() override {
        if ((fifo_.total_pushed() != pushed_) != pushes_) return fifo_.name() + ": only one of RTL and model pushes";
        if (total_popped(fifo_) == popped_) return {};
        const Bits sent = sent_.front();
        sent_.pop_front();
        if (sent == front_) return {};
        return fifo_.name() + ": the model sends " + text(front_) + ", the RTL " + text(sent);
    }

private:
    model::Fifo<T>& fifo_;
    const CData& valid_;
    CData& ready_;
    const Data& data_;
    std::uint64_t pushed_ = 0;
    std::uint64_t popped_ = 0;
    bool pushes_ = false;
    Bits front_;
    std::deque<Bits> sent_;
};

/// Base of the benches.
template <class Module>
class LockstepBench {
public:
    LockstepBench(Module& module, model::Board& board, Random& random)
        : module_(module), board_(board), random_(random) {}
    virtual ~LockstepBench() = default;
    LockstepBench(const LockstepBench&) = delete;
    LockstepBench& operator=(const LockstepBench&) = delete;

    /// Runs until `views` views are delivered, and loads are finished. Returns the first difference, or "".
    std::string run(std::size_t views) {
        constexpr int kMostCycles = 1'000'000;
        reset();
        for (int cycle = 0; cycle < kMostCycles; ++cycle) {
            const std::string difference = step();
            if (!difference.empty()) return "cycle " + std::to_string(cycle) + ": " + difference;
            const auto& images = board_.top().host_bus.images();
            const bool is_done = images.size() == views && images.back().words.size() == images.back().expected_words;
            if (is_done && board_.top().disk_controller.is_idle()) return {};
        }
        return "the views are not delivered";
    }

protected:
    template <class T, class Data>
    void input(model::Fifo<T>& fifo, CData& valid, const CData& ready, Data& data) {
        ends_.push_back(std::make_unique<LockstepInput<T, Data>>(fifo, valid, ready, data));
    }
    template <class T, class Data>
    void output(model::Fifo<T>& fifo, const CData& valid, CData& ready, const Data& data) {
        ends_.push_back(std::make_unique<LockstepOutput<T, Data>>(fifo, valid, ready, data));
    }
    /// Inputs that belong to no FIFO, before `look_up()`.
    virtual void drive() {}
    /// Answers the module's look-ups in the register file, which take no cycle.
    virtual void look_up() = 0;
    /// Compares outputs that belong to no FIFO, before the model's cycle. Returns the difference, or "".
    virtual std::string compare() { return {}; }

    // An empty bank is read only while no block has a view.
    [[nodiscard]] const model::BoardView& view(int number) const {
        static const model::BoardView kNone;
        const model::RegisterFile& registers = board_.top().registers;
        const auto& views = registers.banks[static_cast<std::size_t>(registers.active)].views;
        if (views.empty()) return kNone;
        return views[number < static_cast<int>(views.size()) ? static_cast<std::size_t>(number) : 0];
    }
    [[nodiscard]] const model::ObjectRegisters& object(int view_number) const {
        return board_.top().registers.objects[static_cast<std::size_t>(view(view_number).object)];
    }

    Module& module_;
    model::Board& board_;
    Random& random_;

private:
    void clock_edge() {
        module_.clk = 0;
        module_.eval();
        module_.clk = 1;
        module_.eval();
        module_.clk = 0;
    }
    void reset() {
        module_.rst = 1;
        for (int n = 0; n < 3; ++n) clock_edge();
        module_.rst = 0;
    }
    std::string step() {
        for (const auto& end : ends_) end->drive(random_);
        drive();
        module_.eval();
        look_up();
        std::string difference = compare();
        module_.eval();
        for (const auto& end : ends_) end->sample();
        board_.top().simulator.step();
        for (const auto& end : ends_) difference += end->difference();
        clock_edge();
        return difference;
    }

    std::vector<std::unique_ptr<LockstepEnd>> ends_;
};

/// Result of a run beside a board.
struct LockstepRun {
    std::string difference;  // between model and RTL, or ""
    std::uint64_t cycles = 0;
};

/// Calls `render(module, seed)` with seeds from 0 for at least cosimulated_cycles() cycles.
template <class Module, class Render>
void expect_equal_in_lockstep(Render&& render) {
    VerilatedContext context;
    context.randReset(2);
    Module module(&context);
    std::uint64_t seed = 0;
    for (std::uint64_t cycles = 0; cycles < cosimulated_cycles(); ++seed) {
        const LockstepRun run = render(module, seed);
        ASSERT_EQ(run.difference, "") << "seed " << seed;
        cycles += run.cycles;
    }
}

/// Calls `render(module)` for each mutant of the module (NAME.mutants), which must give a difference, and for mutant 0,
/// the module itself, which must not.
template <class Module, class Render>
void expect_mutants_differ_in_lockstep(Render&& render) {
    const auto render_mutant = [&](int mutant) {
        VerilatedContext context;
        context.randReset(2);
        Module module(&context);
        module.mutant = static_cast<CData>(mutant);
        module.eval();
        return std::pair(render(module).difference, static_cast<int>(module.mutants));
    };
    const auto [difference, mutants] = render_mutant(0);
    EXPECT_EQ(difference, "");
    EXPECT_GE(mutants, kLeastMutants);
    for (int n = 1; n <= mutants; ++n) EXPECT_NE(render_mutant(n).first, "") << "mutant " << n << " is not noticed";
}

}  // namespace rs::engine::rtl
