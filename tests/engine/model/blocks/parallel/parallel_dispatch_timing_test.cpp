// Latency and throughput of the codebook prefetch of a parallel board's pipe, and of the blocks that join the pipes.

#include "engine/model/blocks/parallel/dispatch.hpp"
#include "engine/model/blocks/texels/double_buffered_codebook.hpp"
#include "tests/engine/model/blocks/block_bench.hpp"
#include "tests/engine/model/blocks/parallel_registers.hpp"

namespace rs::engine::model {
namespace {

using test::Bench;
using test::put;
using test::ViewsOfThreeObjects;

struct LookupBench {
    // Runs `steps` cycles and answers requests at once; returns the number of answered words.
    int run(int steps) {
        int answered = 0;
        for (int n = 0; n < steps; ++n) {
            if (reads.can_pop()) {
                reads.pop();
                words.push({0});
                ++answered;
            }
            reads.commit();
            words.commit();
            bench.step(block);
        }
        return answered;
    }
    void view(int number) { put(jobs, {number}); }
    void pixel(int number, int hops) {
        CodedPixel p;
        p.view = number;
        p.is_visible = true;
        p.hops = hops;
        put(in, p);
    }
    ViewsOfThreeObjects r;
    Fifo<ViewJob> jobs{"jobs", 8, 1};
    Fifo<Done> done{"done", 4, 1};
    Fifo<CodedPixel> in{"in", 8, 1};
    Fifo<MemoryRead> reads{"reads", 4, 1};
    Fifo<MemoryWord> words{"words", 4, 1};
    Fifo<YuvaPixel> out{"out", 8, 1};
    DoubleBufferedCodebook block{
        r.file, {.jobs = jobs, .view_done = done, .in = in, .requests = reads, .words = words, .out = out}};
    Bench bench{&jobs, &done, &in, &reads, &words, &out};
};

TEST(ParallelTexelTiming, DoubleBufferedCodebookLoadsDuringLookUpsOfLatencySeven) {
    LookupBench l;
    const auto words = [&](int slot) {
        return static_cast<int>(l.r.file.objects[static_cast<std::size_t>(l.r.slots[slot])].book_words);
    };
    l.view(0);
    l.pixel(0, 1);
    EXPECT_EQ(l.run(words(0) + 3), words(0));
    EXPECT_EQ(l.out.count(), 0);
    EXPECT_EQ(l.bench.cycles_until(l.block, l.out), 6);  // the books' last word came in the step before the last
    l.view(1);                                           // the same object
    l.view(2);                                           // a raw one
    l.view(3);                                           // another object: look-ups continue during its load
    EXPECT_EQ(l.run(4 + 100), 100);
    l.pixel(0, 2);
    l.pixel(0, 4);
    l.pixel(0, 1);
    EXPECT_EQ(l.bench.cycles_until(l.block, l.out), 7);
    EXPECT_EQ(l.bench.cycles_until(l.block, l.out), 3);
    EXPECT_EQ(l.bench.cycles_until(l.block, l.out), 1);
    l.run(words(2));
    EXPECT_EQ(l.block.book_loads(), 2U);
}

TEST(ParallelTexelTiming, DoubleBufferedCodebookReplacesNoBooksOfAViewInFlight) {
    LookupBench l;
    l.view(0);
    l.run(30'000);
    l.view(3);
    l.run(30'000);
    RegisterFile& file = l.r.file;
    file.objects[static_cast<std::size_t>(l.r.slots[0])].serial = 99;  // a third object
    l.view(0);
    EXPECT_EQ(l.run(100), 0);
    EXPECT_EQ(l.block.book_loads(), 2U);
    put(l.done, {});
    EXPECT_GT(l.run(100), 90);
    EXPECT_EQ(l.block.book_loads(), 3U);
}

TEST(ParallelDispatch, AViewIsWrittenWhenAllPipesWithAShareHaveWrittenTheirs) {
    ViewsOfThreeObjects r;
    r.file.banks[0].views[1].width = 20;  // two stripes
    Fifo<ViewJob> in("in", 4, 1);
    Fifo<Done> written("written", 2, 1);
    std::vector<std::unique_ptr<Fifo<ViewJob>>> jobs;
    std::vector<std::unique_ptr<Fifo<Done>>> done;
    std::vector<DispatchPort> ports;
    for (int n = 0; n < 3; ++n) {
        for (int k = 0; k < 3; ++k) jobs.push_back(std::make_unique<Fifo<ViewJob>>("jobs", 4, 1));
        done.push_back(std::make_unique<Fifo<Done>>("done", 4, 1));
        ports.push_back(
            {jobs[jobs.size() - 3].get(), jobs[jobs.size() - 2].get(), jobs.back().get(), done.back().get()});
    }
    ViewDispatcher block(r.file, {.in = in, .pipes = ports, .view_written = written});
    const auto step = [&] {
        block.clock(0);
        for (FifoState* fifo : std::initializer_list<FifoState*>{&in, &written}) fifo->commit();
        for (auto& fifo : jobs) fifo->commit();
        for (auto& fifo : done) fifo->commit();
    };
    for (const int v : {0, 1}) {
        put(in, {v});
        step();
    }
    // 40 columns: three stripes, one each. 20 columns of view 1: pipes 1 and 2.
    EXPECT_EQ(jobs[0]->count(), 1);
    EXPECT_EQ(jobs[3]->count(), 2);
    EXPECT_EQ(jobs[8]->count(), 2);
    const auto pipe_writes = [&](std::size_t n) {
        done[n]->push({});
        done[n]->commit();
        step();
        step();
    };
    pipe_writes(1);
    pipe_writes(1);  // pipe 1 is ahead, at view 1
    pipe_writes(2);
    EXPECT_EQ(written.count(), 0);
    pipe_writes(0);
    EXPECT_EQ(written.count(), 1);
    pipe_writes(2);
    EXPECT_EQ(written.count(), 2);
}

TEST(ParallelDispatch, LoadedWordsGoToAllChannelsInTheSameCycle) {
    Fifo<MemoryWrite> in("in", 4, 1);
    Fifo<Done> loaded("loaded", 2, 1);
    Fifo<MemoryWrite> words[] = {{"a", 2, 1}, {"b", 2, 1}};
    Fifo<Done> done[] = {{"c", 2, 1}, {"d", 2, 1}};
    LoadBroadcast block({.in = in, .channels = {{&words[0], &done[0]}, {&words[1], &done[1]}}, .loaded = loaded});
    Bench bench({&in, &loaded, &words[0], &words[1], &done[0], &done[1]});
    for (std::uint64_t n = 0; n < 3; ++n) {
        put(in, {1, n, n == 2});
    }
    EXPECT_EQ(bench.cycles_until(block, words[1]), 1);
    EXPECT_EQ(words[0].count(), 1);
    bench.step(block);
    words[0].pop();
    words[0].commit();
    EXPECT_EQ(bench.cycles_until(block, words[0], 9), -1);  // the other channel is full
    put(done[1], {});
    EXPECT_EQ(bench.cycles_until(block, loaded, 9), -1);
    put(done[0], {});
    EXPECT_EQ(bench.cycles_until(block, loaded), 1);
}

TEST(ParallelDispatch, EveryColumnHasOneOwnerAndSharesAreEven) {
    for (const int pipes : {1, 3, 8}) {
        for (int view = 0; view < 15; ++view) {
            std::vector<int> columns(static_cast<std::size_t>(pipes));
            for (int x = 0; x < 512; ++x) {
                const int owner = stripe_owner(view, x, pipes);
                for (int p = 0; p < pipes; ++p) EXPECT_EQ((StripeShare{p, pipes}.owns_column(view, x)), p == owner);
                ++columns[static_cast<std::size_t>(owner)];
            }
            for (int p = 0; p < pipes; ++p) {
                EXPECT_TRUE((StripeShare{p, pipes}.owns_column(view, StripeShare{p, pipes}.first_column(view))));
                EXPECT_NEAR(columns[static_cast<std::size_t>(p)], 512 / pipes, 16);
            }
        }
    }
}

}  // namespace
}  // namespace rs::engine::model
