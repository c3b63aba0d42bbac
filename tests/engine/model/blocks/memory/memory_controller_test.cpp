// Memory controller: latency, row misses, batches, the maintenance window, and full answer FIFOs.

#include "engine/model/blocks/memory/memory_controller.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace rs::engine::model {
namespace {

struct PortBench {
    explicit PortBench(const MemorySettings& s = {})
        : settings(s),
          sdram(settings.shape, settings.timing),
          controller("memory", settings, sdram,
                     {.read_ports = {{"a", &reads, &words}},
                      .image_writes = writes,
                      .view_written = written,
                      .loads = loads,
                      .object_loaded = loaded}) {}
    void step() {
        controller.clock(now++);
        for (FifoState* f : std::initializer_list<FifoState*>{&reads, &words, &writes, &written, &loads, &loaded})
            f->commit();
    }
    void request(WordAddress address, bool null = false) {
        reads.push({address, null});
        reads.commit();
    }
    void write(WordAddress address, std::uint64_t data, bool last = false) {
        writes.push({address, data, last});
        writes.commit();
    }
    // Steps until a word has been returned.
    int cycles_until_word() {
        for (int n = 1; n < 100; ++n) {
            step();
            if (words.can_pop()) return n;
        }
        return -1;
    }

    MemorySettings settings;
    Sdram sdram;
    Fifo<MemoryRead> reads{"reads", 32, 1};
    Fifo<MemoryWord> words{"words", 4, 64};
    Fifo<MemoryWrite> writes{"writes", 32, 92};
    Fifo<Done> written{"written", 2, 1};
    Fifo<MemoryWrite> loads{"loads", 64, 92};
    Fifo<Done> loaded{"loaded", 2, 1};
    MemoryController controller;
    std::uint64_t now = 0;
};

TEST(MemoryController, AReadTakesFiveCyclesAndAClosedOrOtherRowCostsItsCommands) {
    PortBench bench;
    bench.sdram.set_word(7, 70);
    bench.request(7);
    EXPECT_EQ(bench.cycles_until_word(), 1 + 5);  // activate, then the read
    EXPECT_EQ(bench.words.pop().data, 70U);
    bench.words.commit();
    bench.request(8);
    EXPECT_EQ(bench.cycles_until_word(), 5);
    bench.words.pop();
    bench.words.commit();
    bench.request(7 + (1 << 10));
    EXPECT_EQ(bench.cycles_until_word(), 2 + 5);  // precharge, activate, the read
    EXPECT_EQ(bench.controller.counters().row_misses, 2U);
    EXPECT_EQ(bench.controller.counters().words_read[0], 3U);
}

TEST(MemoryController, ANullReadTakesASlotAndNoCommand) {
    PortBench bench;
    bench.sdram.set_word(0, 5);
    bench.request(0, true);
    EXPECT_EQ(bench.cycles_until_word(), 5);
    EXPECT_EQ(bench.words.front().data, 0U);
    EXPECT_EQ(bench.sdram.commands(SdramCommand::activate), 0U);
    EXPECT_EQ(bench.controller.counters().nulls[0], 1U);
}

TEST(MemoryController, NeverRequestsMoreThanTheAnswerFifoHolds) {
    PortBench bench;
    for (WordAddress n = 0; n < 20; ++n) bench.request(n);
    for (int n = 0; n < 50; ++n) bench.step();
    EXPECT_EQ(bench.words.count(), 4);
    EXPECT_EQ(bench.reads.count(), 16);
    EXPECT_EQ(bench.controller.last_activity(), Activity::output_full);
}

TEST(MemoryController, ReadsOfAnOpenRowTakeOneCycleEach) {
    PortBench bench;
    for (WordAddress n = 0; n < 3; ++n) bench.request(n);
    EXPECT_EQ(bench.cycles_until_word(), 6);
    for (int n = 0; n < 2; ++n) {
        bench.words.pop();
        bench.step();
        EXPECT_TRUE(bench.words.can_pop());
    }
}

TEST(MemoryController, WritesWaitForABatchDuringReadsAndTurnTheBusOnce) {
    PortBench bench;
    for (WordAddress n = 0; n < 4; ++n) bench.request(n);
    for (WordAddress n = 0; n < 7; ++n) bench.write(100 + n, n);
    for (int n = 0; n < 5; ++n) bench.step();  // activate and four reads
    EXPECT_EQ(bench.controller.counters().image_words, 0U);
    EXPECT_EQ(bench.controller.counters().words_read[0], 4U);
    // No port reads: the available words are written, three cycles after the last read and one turnaround cycle.
    for (int n = 0; n < 3; ++n) bench.step();
    EXPECT_EQ(bench.controller.last_activity(), Activity::turnaround);
    EXPECT_EQ(bench.controller.counters().image_words, 0U);
    bench.step();
    EXPECT_EQ(bench.controller.counters().image_words, 1U);
    for (int n = 0; n < 6; ++n) bench.step();
    EXPECT_EQ(bench.controller.counters().image_words, 7U);
    EXPECT_EQ(bench.controller.counters().write_batches, 1U);
}

TEST(MemoryController, TheLastWordOfAViewIsReported) {
    PortBench bench;
    bench.write(100, 1);
    bench.write(101, 2, true);
    for (int n = 0; n < 2; ++n) bench.step();  // activate, the first word
    EXPECT_EQ(bench.written.count(), 0);
    bench.step();
    EXPECT_EQ(bench.written.count(), 1);
}

// Port cycles used by maintenance, over several windows.
std::uint64_t maintenance_cycles(int load_words) {
    PortBench bench;
    for (int n = 0; n < load_words; ++n) {
        bench.loads.push({static_cast<WordAddress>(n), 1000U + static_cast<std::uint64_t>(n), n + 1 == load_words});
        bench.loads.commit();
    }
    for (int n = 0; n < 5 * 312; ++n) bench.step();
    EXPECT_EQ(bench.controller.counters().windows, 4U);
    EXPECT_EQ(bench.sdram.commands(SdramCommand::refresh), 4U);
    EXPECT_EQ(bench.controller.counters().load_words, static_cast<std::uint64_t>(load_words));
    for (int n = 0; n < load_words; ++n) {
        EXPECT_EQ(bench.sdram.word(static_cast<WordAddress>(n)), 1000U + static_cast<std::uint64_t>(n));
    }
    EXPECT_EQ(bench.loaded.count(), load_words > 0 ? 1 : 0);
    return bench.controller.counts().of(Activity::maintenance);
}

TEST(MemoryController, TheMaintenanceWindowTakesTheSameTimeWithAndWithoutLoading) {
    const std::uint64_t empty = maintenance_cycles(0);
    EXPECT_EQ(empty, 4U * (2 + 26 - 1));  // precharge, refresh, and 26 cycles from the refresh on
    EXPECT_EQ(maintenance_cycles(1), empty);
    EXPECT_EQ(maintenance_cycles(20), empty);
    EXPECT_EQ(maintenance_cycles(64), empty);  // four windows
}

TEST(MemoryController, AWindowLoadsTwentyWordsOfOneRow) {
    PortBench bench;
    for (WordAddress n = 0; n < 30; ++n) {
        bench.loads.push({1014 + n, n, false});
        bench.loads.commit();
    }
    for (int n = 0; n < 312 + 60; ++n) bench.step();
    EXPECT_EQ(bench.controller.counters().load_words, 10U);  // up to the end of the row
    for (int n = 0; n < 312; ++n) bench.step();
    EXPECT_EQ(bench.controller.counters().load_words, 30U);
}

}  // namespace
}  // namespace rs::engine::model
