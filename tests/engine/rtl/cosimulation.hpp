#pragma once
// Co-simulation of an RTL module and its block of the model: both read and write the same FIFOs of the model. In every
// cycle all handshakes are compared, and each message that the RTL sends is compared with that of the model.
//
// A bench (see column_address_test.cpp) holds the model's registers, FIFOs and block, and connects the ports of the
// verilated module to the FIFOs. The test runs episodes: new random registers, a reset of the module at any point of
// its work, and traffic whose rates differ from FIFO to FIFO and change at random.

#include "engine/model/clock/block.hpp"
#include "tests/engine/rtl/bits.hpp"
#include "tests/engine/rtl/parallel_bits.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <deque>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace rs::engine::rtl {

/// A message of a FIFO of `width_bits`. Most messages have one width.
template <class T>
Bits pack(const T& message, int /*width_bits*/) {
    return pack(message);
}

/// Random numbers of a test.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    /// Uniform over low..high, both included.
    std::int64_t in(std::int64_t low, std::int64_t high) {
        return std::uniform_int_distribution<std::int64_t>(low, high)(engine_);
    }
    bool chance(double probability) { return std::uniform_real_distribution<>()(engine_) < probability; }
    std::uint64_t word() { return engine_(); }
    /// A signed number of up to `width_bits` bits, all lengths alike, so that small and extreme ones are frequent.
    std::int64_t of_any_length(int width_bits) {
        const std::int64_t value = static_cast<std::int64_t>(word()) >> (64 - in(1, width_bits));
        return value;
    }

private:
    std::mt19937_64 engine_;
};

/// Rate at which the environment pushes or pops: random, and another one after a random time.
class Pace {
public:
    bool acts(Random& random) {
        if (left_-- <= 0) {
            constexpr double kRates[] = {0.02, 0.2, 0.5, 0.9, 1.0, 1.0};
            rate_ = kRates[random.in(0, 5)];
            left_ = random.in(1, 300);
        }
        return rate_ >= 1.0 || random.chance(rate_);
    }

private:
    double rate_ = 0;
    std::int64_t left_ = 0;
};

/// FIFO of the model with the ports of the module that read or write it.
class Channel {
public:
    virtual ~Channel() = default;
    virtual void act(Random& random) = 0;    // the environment's push or pop of this cycle
    virtual void drive(Random& random) = 0;  // inputs of the module
    virtual void sample() = 0;               // outputs of the module, once they are stable
    // Ends the model's cycle. Returns the difference between model and RTL, or "".
    virtual std::string commit(std::uint64_t cycle) = 0;
    virtual std::string drain() { return {}; }  // compares the messages left in an output FIFO
};

// A random value on the data lines of an empty FIFO: the module must not depend on it.
inline Bits random_bits(Random& random, int width_bits = 0) {
    Bits bits;
    constexpr int kLeastWords = 12;
    const auto words = static_cast<std::size_t>(std::max(kLeastWords, (width_bits + 31) / 32));
    for (std::size_t n = 0; n < words; ++n) bits.words[n] = static_cast<std::uint32_t>(random.word());
    return bits;
}

// Ends a cycle. Both ends of a FIFO between two clocks are on the clock of the module.
template <class T>
void end_cycle(model::Fifo<T>& fifo) {
    fifo.commit();
}
template <class T>
void end_cycle(model::CrossingFifo<T>& fifo) {
    fifo.commit_writer();
    fifo.commit_reader();
}

template <template <class> class Fifo, class T, class Data>
class InputChannel final : public Channel {
public:
    /// The environment pushes `make()` while `may_push()`.
    InputChannel(Fifo<T>& fifo, CData& valid, const CData& ready, Data& data, std::function<T()> make,
                 std::function<bool()> may_push)
        : fifo_(fifo),
          valid_(valid),
          ready_(ready),
          data_(data),
          make_(std::move(make)),
          may_push_(std::move(may_push)) {}

    void act(Random& random) override {
        pushed_ = pace_.acts(random) && fifo_.can_push() && (!may_push_ || may_push_());
        if (pushed_) fifo_.push(make_());
    }
    void drive(Random& random) override {
        valid_ = fifo_.can_pop();
        write_port(data_,
                   valid_ != 0 ? pack(fifo_.front(), fifo_.width_bits()) : random_bits(random, fifo_.width_bits()),
                   fifo_.width_bits());
        before_ = fifo_.count();
    }
    void sample() override { rtl_popped_ = valid_ != 0 && ready_ != 0; }
    std::string commit(std::uint64_t /*cycle*/) override {
        end_cycle(fifo_);
        const bool popped = before_ + static_cast<int>(pushed_) - fifo_.count() != 0;
        if (popped == rtl_popped_) return {};
        return fifo_.name() + ": " + (popped ? "only the model pops" : "only the RTL pops");
    }

private:
    Fifo<T>& fifo_;
    CData& valid_;
    const CData& ready_;
    Data& data_;
    std::function<T()> make_;
    std::function<bool()> may_push_;
    Pace pace_;
    bool pushed_ = false;
    bool rtl_popped_ = false;
    int before_ = 0;
};

template <template <class> class Fifo, class T, class Data>
class OutputChannel final : public Channel {
public:
    /// `taken` is called with each message that the environment pops.
    OutputChannel(Fifo<T>& fifo, const CData& valid, CData& ready, const Data& data,
                  std::function<void(const T&)> taken)
        : fifo_(fifo), valid_(valid), ready_(ready), data_(data), taken_(std::move(taken)) {}

    void act(Random& random) override {
        if (pace_.acts(random) && fifo_.can_pop()) difference_ = pop();
    }
    void drive(Random& /*random*/) override { ready_ = fifo_.can_push(); }
    void sample() override {
        rtl_pushed_ = valid_ != 0 && ready_ != 0;
        rtl_data_ = read_port(data_, fifo_.width_bits());
    }
    std::string commit(std::uint64_t cycle) override {
        const std::uint64_t before = fifo_.total_pushed();
        end_cycle(fifo_);
        const bool pushed = fifo_.total_pushed() != before;
        if (pushed != rtl_pushed_)
            return fifo_.name() + ": " + (pushed ? "only the model pushes" : "only the RTL pushes");
        if (pushed) sent_.push_back({cycle, rtl_data_});
        return std::exchange(difference_, {});
    }
    std::string drain() override {
        std::string difference;
        while (difference.empty() && fifo_.can_pop()) {
            difference = pop();
            end_cycle(fifo_);
        }
        return difference;
    }

private:
    struct Sent {
        std::uint64_t cycle = 0;
        Bits data;
    };
    std::string pop() {
        const T message = fifo_.pop();
        const Sent sent = sent_.front();
        sent_.pop_front();
        if (taken_) taken_(message);
        const Bits expected = pack(message, fifo_.width_bits());
        if (expected == sent.data) return {};
        return fifo_.name() + ": the model pushes " + text(expected) + " (" + text(message) + "), the RTL " +
               text(sent.data) + " in cycle " + std::to_string(sent.cycle);
    }

    Fifo<T>& fifo_;
    const CData& valid_;
    CData& ready_;
    const Data& data_;
    std::function<void(const T&)> taken_;
    Pace pace_;
    std::deque<Sent> sent_;
    bool rtl_pushed_ = false;
    Bits rtl_data_;
    std::string difference_;
};

// Ports NAME_valid, NAME_ready and NAME_data of a module.
#define RS_RTL_PORTS(module, name) (module).name##_valid, (module).name##_ready, (module).name##_data

inline constexpr std::int64_t kUsualEpisode = 4000;

/// Base of the benches: connects a module to the model's FIFOs.
template <class Module>
class Bench {
public:
    static constexpr std::int64_t kLongestEpisode = kUsualEpisode;  // cycles between resets

    Bench(Module& module, Random& random) : module_(module), random_(random) {}
    virtual ~Bench() = default;
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    /// Runs `cycles` cycles. Returns the first difference between model and RTL, or "".
    std::string run(std::uint64_t cycles) {
        reset();
        for (std::uint64_t cycle = 0; cycle < cycles; ++cycle) {
            const std::string difference = step(cycle);
            if (!difference.empty()) return "cycle " + std::to_string(cycle) + ": " + difference;
        }
        for (const auto& channel : channels_) {
            const std::string difference = channel->drain();
            if (!difference.empty()) return "at the end: " + difference;
        }
        return {};
    }

protected:
    template <template <class> class Fifo, class T, class Data>
    void input(Fifo<T>& fifo, CData& valid, const CData& ready, Data& data,
               std::type_identity_t<std::function<T()>> make, std::function<bool()> may_push = {}) {
        channels_.push_back(std::make_unique<InputChannel<Fifo, T, Data>>(fifo, valid, ready, data, std::move(make),
                                                                          std::move(may_push)));
    }
    template <template <class> class Fifo, class T, class Data>
    void output(Fifo<T>& fifo, const CData& valid, CData& ready, const Data& data,
                std::type_identity_t<std::function<void(const T&)>> taken = {}) {
        channels_.push_back(std::make_unique<OutputChannel<Fifo, T, Data>>(fifo, valid, ready, data, std::move(taken)));
    }
    virtual model::Block& block() = 0;
    /// Answers the module's look-ups in the register file, which take no cycle.
    virtual void look_up() {}
    /// Compares outputs that belong to no FIFO, before the clock edge. Returns the difference, or "".
    virtual std::string compare() { return {}; }

    Module& module_;
    Random& random_;

private:
    void settle() {
        module_.eval();
        look_up();
        module_.eval();
    }
    void clock_edge() {
        module_.clk = 1;
        module_.eval();
        module_.clk = 0;
    }
    void reset() {
        module_.clk = 0;
        module_.rst = 1;
        for (std::int64_t n = random_.in(1, 3); n > 0; --n) {
            for (const auto& channel : channels_) channel->drive(random_);
            settle();
            clock_edge();
        }
        module_.rst = 0;
    }
    std::string step(std::uint64_t cycle) {
        for (const auto& channel : channels_) channel->drive(random_);
        for (const auto& channel : channels_) channel->act(random_);
        settle();
        for (const auto& channel : channels_) channel->sample();
        block().clock(cycle);
        std::string difference = compare();
        for (const auto& channel : channels_) {
            const std::string found = channel->commit(cycle);
            if (difference.empty()) difference = found;
        }
        clock_edge();
        return difference;
    }

    std::vector<std::unique_ptr<Channel>> channels_;
};

/// Co-simulates for `cycles` cycles in episodes of random length; benches of long episodes for as many of them.
/// `select` is called with the new module: it chooses a mutant. Returns the first difference, or "".
template <template <class> class BenchOf, class Module, class Select>
std::string cosimulate(std::uint64_t cycles, std::uint64_t seed, Select&& select) {
    Random random(seed);
    VerilatedContext context;
    context.randReset(2);  // registers without a reset begin with random values
    context.randSeed(static_cast<int>(random.in(1, 1 << 30)));
    Module module(&context);
    select(module);
    constexpr std::int64_t kLongest = BenchOf<Module>::kLongestEpisode;
    for (std::uint64_t done = 0; done < cycles * static_cast<std::uint64_t>(kLongest / kUsualEpisode);) {
        const auto episode = static_cast<std::uint64_t>(random.in(1, kLongest));
        auto bench = std::make_unique<BenchOf<Module>>(module, random);
        const std::string difference = bench->run(episode);
        if (!difference.empty()) {
            return "seed " + std::to_string(seed) + ", after " + std::to_string(done) + " cycles: " + difference;
        }
        done += episode;
    }
    return {};
}

/// Cycles of a co-simulation: 100,000, or RAYSPACE_RTL_CYCLES.
inline std::uint64_t cosimulated_cycles() {
    constexpr std::uint64_t kCycles = 100'000;
    const char* const cycles = std::getenv("RAYSPACE_RTL_CYCLES");
    return cycles == nullptr ? kCycles : std::strtoull(cycles, nullptr, 10);
}
inline constexpr std::uint64_t kMutantCycles = 100'000;
inline constexpr int kLeastMutants = 5;

template <template <class> class BenchOf, class Module>
void expect_equal_to_model() {
    EXPECT_EQ((cosimulate<BenchOf, Module>(cosimulated_cycles(), 1, [](Module&) {})), "");
}

/// Every mutant of the module (NAME.mutants) must differ from the model; mutant 0 is the module itself.
template <template <class> class BenchOf, class Module>
void expect_mutants_differ() {
    int mutants = 0;
    EXPECT_EQ((cosimulate<BenchOf, Module>(kMutantCycles, 2,
                                           [&](Module& module) {
                                               module.mutant = 0;
                                               module.eval();
                                               mutants = module.mutants;
                                           })),
              "");
    EXPECT_GE(mutants, kLeastMutants);
    for (int n = 1; n <= mutants; ++n) {
        EXPECT_NE((cosimulate<BenchOf, Module>(kMutantCycles, 2,
                                               [&](Module& module) { module.mutant = static_cast<CData>(n); })),
                  "")
            << "mutant " << n << " is not noticed";
    }
}

// Tests of a module: VNAME is the verilated module, VNAME_mutants the one with its mutants.
#define RS_RTL_TESTS(suite, bench, name)                                    \
    TEST(suite, EqualsTheModel) {                                           \
        rs::engine::rtl::expect_equal_to_model<bench, V##name>();           \
    }                                                                       \
    TEST(suite, MutantsDifferFromTheModel) {                                \
        rs::engine::rtl::expect_mutants_differ<bench, V##name##_mutants>(); \
    }

}  // namespace rs::engine::rtl
