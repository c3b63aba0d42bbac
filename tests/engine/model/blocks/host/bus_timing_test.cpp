// The host bus and the disk controller, clock by clock.

#include "engine/model/blocks/host/host_bus.hpp"
#include "engine/model/blocks/memory/disk_controller.hpp"

#include <gtest/gtest.h>

namespace rs::engine::model {
namespace {

// The bus without other blocks; the board side always has words.
struct BusBench {
    explicit BusBench(const PciSettings& s)
        : settings(s), bus(settings, programs, {.words = words, .commands = commands, .transferred = transferred}) {}
    void step() {
        if (left > 0 && words.can_push())
            words.push(left-- == size + 1 ? head
                                          : ImageWord{100U + static_cast<std::uint64_t>(size - left), false, false});
        words.commit_writer();
        commands.commit_reader();
        transferred.commit_reader();
        bus.clock(now++);
        words.commit_reader();
        commands.commit_writer();
        transferred.commit_writer();
    }
    void send(int image_words) {
        size = image_words;
        left = image_words + 1;
        head = {static_cast<std::uint64_t>(image_words), true, true};
    }
    PciSettings settings;
    HostPrograms programs;
    CrossingFifo<ImageWord> words{"words", 32, 66};
    CrossingFifo<StartCommand> commands{"commands", 4, 1};
    CrossingFifo<Done> transferred{"transferred", 2, 1};
    HostBus bus;
    ImageWord head;
    int size = 0;
    int left = 0;
    std::uint64_t now = 0;
};

TEST(HostBus, ABurstTakesItsClocks) {
    EXPECT_EQ(HostBus::burst_clocks(PciSettings{}, 4), 3 + 1 + 8 + 8 * 2 + 1);
    for (const int burst : {1, 4, 16}) {
        PciSettings settings;
        settings.burst_words = burst;
        BusBench bench(settings);
        bench.send(48);
        std::vector<std::uint64_t> ends;  // bus clock of the last word of each burst
        std::size_t seen = 0;
        for (int n = 0; n < 3000; ++n) {
            bench.step();
            if (bench.bus.images().empty()) continue;
            const std::size_t count = bench.bus.images().back().words.size();
            if (count > seen && count % static_cast<std::size_t>(burst) == 0) ends.push_back(bench.now);
            seen = count;
        }
        ASSERT_EQ(ends.size(), 48U / static_cast<std::size_t>(burst));
        for (std::size_t n = 2; n < ends.size(); ++n) {
            EXPECT_EQ(ends[n] - ends[n - 1], static_cast<std::uint64_t>(HostBus::burst_clocks(settings, burst)));
        }
        for (std::size_t n = 0; n < 48; ++n) EXPECT_EQ(bench.bus.images().back().words[n], 101 + n);
        EXPECT_TRUE(bench.transferred.can_pop());
    }
}

// 64 bits halve the transfers of a burst, and so does compression; neither loses a word.
TEST(HostBus, WidthAndCompressionHalveTheTransfers) {
    PciSettings wide;
    wide.width_bits = 64;
    PciSettings compressed;
    compressed.compression = 2;
    EXPECT_EQ(HostBus::burst_clocks(wide, 4), 3 + 1 + 8 + 4 * 2 + 1);
    EXPECT_EQ(HostBus::burst_clocks(compressed, 8), 3 + 1 + 8 + 8 * 2 + 1);
    EXPECT_EQ(HostBus::burst_clocks(compressed, 3), 3 + 1 + 8 + 3 * 2 + 1);
    for (const PciSettings& settings : {wide, compressed}) {
        BusBench bench(settings);
        bench.send(47);  // the last burst has fewer words
        std::uint64_t end = 0;
        for (int n = 0; n < 1000 && end == 0; ++n) {
            bench.step();
            if (bench.transferred.count() > 0) end = bench.now;
        }
        ASSERT_EQ(bench.bus.images().size(), 1U);
        ASSERT_EQ(bench.bus.images().back().words.size(), 47U);
        for (std::size_t n = 0; n < 47; ++n) EXPECT_EQ(bench.bus.images().back().words[n], 101 + n);
        EXPECT_EQ(bench.bus.counters().image_bytes, settings.width_bits == 64 ? 47U * 8 : 47U * 4);
    }
}

TEST(HostBus, TheClocksOfAnImageAreThoseOfItsBurstsAndThePause) {
    PciSettings settings;
    BusBench bench(settings);
    bench.send(46);
    while (bench.bus.images().empty()) bench.step();
    while (bench.words.visible() < 4) bench.step();
    const std::uint64_t begin = bench.now;
    while (bench.transferred.count() == 0) bench.step();
    // The pause is taken after the last transfer instead of a turnaround.
    EXPECT_EQ(bench.now - begin + 1 + static_cast<std::uint64_t>(settings.interrupt_clocks),
              HostBus::image_clocks(settings, 46));
}

TEST(HostBus, OnADedicatedBusRegisterWritesTakeNothingFromTheBursts) {
    PciSettings settings;
    settings.dedicated = 1;
    BusBench bench(settings);
    bench.programs.push_back({{}, 1000});
    bench.send(400);
    for (int n = 0; n < 100 * 29 + 10; ++n) bench.step();
    EXPECT_NEAR(static_cast<double>(bench.bus.counters().bursts), 100, 1);
    EXPECT_NEAR(static_cast<double>(bench.bus.counters().register_writes), 100 * 29 / 4.0, 4);
    for (int n = 0; n < 4000; ++n) bench.step();
    EXPECT_EQ(bench.bus.counters().register_writes, 1000U);
    EXPECT_EQ(bench.commands.count(), 1);
}

TEST(HostBus, RegisterWritesTakeTheirClocksAndEndInACommand) {
    BusBench bench(PciSettings{});
    bench.programs.push_back({{}, 10});
    for (int n = 0; n < 40; ++n) {
        EXPECT_EQ(bench.commands.count(), 0);
        bench.step();
    }
    EXPECT_EQ(bench.commands.count(), 1);
    EXPECT_EQ(bench.bus.counters().register_writes, 10U);
}

TEST(HostBus, BurstsAndRegisterWritesAlternate) {
    BusBench bench(PciSettings{});
    bench.programs.push_back({{}, 1000});
    bench.send(400);
    for (int n = 0; n < 100 * 33; ++n) bench.step();
    EXPECT_NEAR(static_cast<double>(bench.bus.counters().bursts), 100, 2);
    EXPECT_NEAR(static_cast<double>(bench.bus.counters().register_writes), 100, 3);
}

TEST(DiskController, AWordCrossesThePrivateBusInSixteenCycles) {
    DiskSettings settings;
    settings.media_cycles_per_sector = 10;  // the disk is faster than the bus
    RegisterFile registers;
    registers.objects.resize(20);
    registers.loaded.resize(20);
    Fifo<MemoryWrite> words("words", 64, 92);
    Fifo<Done> loaded("loaded", 2, 1);
    Fifo<Done> ready("ready", 2, 5);
    DiskController disk(settings, registers, {.words = words, .loaded = loaded, .object_ready = ready});
    disk.load(
        {3,
         {},
         std::make_shared<const std::vector<MemorySegment>>(std::vector<MemorySegment>{{50, {1, 2}}, {90, {3}}})});
    std::uint64_t now = 0;
    const auto step = [&] {
        disk.clock(now++);
        words.commit();
        loaded.commit();
        ready.commit();
    };
    const auto cycles_until_word = [&](int count) {
        const std::uint64_t begin = now;
        while (words.count() < count && now < begin + 100) step();
        return now - begin;
    };
    cycles_until_word(1);
    EXPECT_EQ(cycles_until_word(2), 16U);
    EXPECT_EQ(cycles_until_word(3), 16U);
    EXPECT_EQ(words.pop().address, 50U);
    words.commit();
    EXPECT_FALSE(words.front().last);
    EXPECT_EQ(words.pop().address, 51U);
    words.commit();
    EXPECT_EQ(words.front().address, 90U);
    EXPECT_TRUE(words.front().last);
    for (int n = 0; n < 50; ++n) step();
    EXPECT_FALSE(ready.can_pop());  // the last word is not in memory yet
    loaded.push({});
    loaded.commit();
    step();
    ASSERT_TRUE(ready.can_pop());
    EXPECT_EQ(ready.front().number, 3);
    EXPECT_TRUE(registers.loaded[3].valid);
    EXPECT_FALSE(registers.objects[3].valid);  // the render controller copies the registers
}

}  // namespace
}  // namespace rs::engine::model
