// Latency and throughput of the texel blocks of a parallel board.

#include "engine/model/blocks/texels/texel_cache.hpp"
#include "engine/model/blocks/texels/texel_fills.hpp"
#include "engine/model/blocks/texels/texel_tags.hpp"
#include "engine/model/limits/parallel_layout.hpp"
#include "tests/engine/model/blocks/block_bench.hpp"
#include "tests/engine/model/blocks/parallel_registers.hpp"

namespace rs::engine::model {
namespace {

using test::Bench;
using test::put;
using test::ViewsOfThreeObjects;

PlacedSample sample_at(int image, int left, int top, int fx, int fy, int view = 0) {
    PlacedSample sample;
    sample.view = view;
    sample.inside = true;
    sample.image = image;
    sample.left = left;
    sample.top = top;
    sample.fx = fx;
    sample.fy = fy;
    return sample;
}

struct TagsBench {
    void push(const PlacedSample& sample) { put(in, sample); }
    ViewsOfThreeObjects r;
    Fifo<PlacedSample> in{"in", 8, 1};
    Fifo<TexelFill> fills{"fills", 32, 1};
    Fifo<WaitingSample> out{"out", 32, 1};
    TexelTags block{r.file, {.in = in, .fills = fills, .out = out}};
    Bench bench{&in, &fills, &out};
};

TEST(ParallelTexelTiming, TexelTagsTakeACycleMoreForEachMissingBlock) {
    TagsBench t;
    t.push(sample_at(1, 7, 15, 3, 5));  // four blocks
    EXPECT_EQ(t.bench.cycles_until(t.block, t.out), 5);
    EXPECT_EQ(t.fills.count(), 4);
    EXPECT_EQ(t.out.front().fills, 4);
    t.push(sample_at(1, 7, 15, 3, 5));
    t.push(sample_at(1, 7, 15, 0, 0));
    t.push(sample_at(1, 7, 16, 0, 0));  // weights of 0 need no blocks
    for (int n = 0; n < 3; ++n) EXPECT_EQ(t.bench.cycles_until(t.block, t.out), 1);
    EXPECT_EQ(t.fills.count(), 4);
    t.push(sample_at(1, 7, 16, 0, 0, 1));  // another view of the same object
    EXPECT_EQ(t.bench.cycles_until(t.block, t.out), 1);
    t.push(sample_at(1, 7, 16, 0, 0, 3));  // another object
    EXPECT_EQ(t.bench.cycles_until(t.block, t.out), 2);
    PlacedSample outside;
    t.push(outside);
    EXPECT_EQ(t.bench.cycles_until(t.block, t.out), 1);
    EXPECT_EQ(t.fills.count(), 5);
}

TEST(ParallelTexelTiming, TexelTagsReplaceTheOlderLineAfterItsLastReader) {
    TagsBench t;
    // Blocks 0, 4 and 8 of a row share a set.
    for (const int block : {0, 4, 0, 8}) {
        t.push(sample_at(2, 8 * block, 0, 0, 0));
        EXPECT_EQ(t.bench.cycles_until(t.block, t.out), block == 0 && t.fills.count() == 2 ? 1 : 2);
    }
    ASSERT_EQ(t.fills.count(), 3);
    const TexelFill first = t.fills.pop();
    t.fills.commit();
    const TexelFill second = t.fills.pop();
    t.fills.commit();
    EXPECT_NE(first.line, second.line);
    EXPECT_EQ(t.fills.front().line, second.line);
    EXPECT_EQ(t.fills.front().guard, 2U);  // the second sample read it last
    t.push(sample_at(2, 0, 0, 0, 0));
    EXPECT_EQ(t.bench.cycles_until(t.block, t.out), 1);  // still in the cache
}

// The guard has 10 bits: a line that was last read more than 512 samples ago is as one read 512 samples ago.
TEST(ParallelTexelTiming, TexelTagsSendAGuardOfTheLast512Samples) {
    for (const std::uint32_t between : {0U, 510U, 511U, 512U, 1021U, 1022U, 1023U, 1535U, 5000U}) {
        TagsBench t;
        const auto pass = [&](const PlacedSample& sample) {
            t.push(sample);
            ASSERT_NE(t.bench.cycles_until(t.block, t.out), -1);
            t.out.pop();
            t.out.commit();
        };
        pass(sample_at(2, 0, 0, 0, 0));
        pass(sample_at(2, 8 * 4, 0, 0, 0));
        for (std::uint32_t n = 0; n < between; ++n) pass({});
        pass(sample_at(2, 8 * 8, 0, 0, 0));
        const std::uint32_t samples = 2 + between;
        ASSERT_EQ(t.fills.count(), 3);
        t.fills.pop();
        t.fills.commit();
        t.fills.pop();
        t.fills.commit();
        EXPECT_EQ(t.fills.front().guard, samples > 513 ? (samples - 512) % 1024 : 1U) << between;
    }
}

TEST(ParallelTexelTiming, FillFetchTakes64CyclesForACodedBlockAndAWordPerCycleForARawOne) {
    ViewsOfThreeObjects r;
    Fifo<TexelFill> in("in", 4, 1);
    Fifo<BlockRequest> asks("asks", 64, 1);
    Fifo<CodedPixel> pixels("pixels", 256, 1);
    Fifo<MemoryRead> raw("raw", 64, 1);
    Fifo<FillKind> kinds("kinds", 4, 1);
    Fifo<FillTarget> targets("targets", 4, 1);
    FillFetch block(r.file,
                    {.in = in, .asks = asks, .pixels = pixels, .raw_reads = raw, .kinds = kinds, .targets = targets});
    Bench bench({&in, &asks, &pixels, &raw, &kinds, &targets});
    put(in, {0, 2, 3, 1, 9, 0});
    for (int n = 0; n < 64; ++n) EXPECT_EQ(bench.cycles_until(block, pixels), 1) << n;
    ASSERT_EQ(asks.count(), 8);
    EXPECT_TRUE(asks.front().first);
    EXPECT_EQ(asks.front().column, 24);
    EXPECT_EQ(asks.front().rows, 0xFFU);
    EXPECT_EQ(targets.front().line, 9);
    put(in, {2, 2, 3, 1, 10, 0});
    for (int n = 0; n < kRawBlockWords; ++n) EXPECT_EQ(bench.cycles_until(block, raw), 1) << n;
    EXPECT_EQ(bench.cycles_until(block, raw, 9), -1);
    const ObjectRegisters& object = r.file.objects[static_cast<std::size_t>(r.slots[1])];
    EXPECT_EQ(raw.front().address, object.raw_blocks + static_cast<WordAddress>((2 * 10 + 3) * 9 + 1) * kRawBlockWords);
    EXPECT_EQ(pixels.count(), 64);
}

TEST(ParallelTexelTiming, TexelMergeKeepsTheOrderOfTheBlocks) {
    Fifo<FillKind> kinds("kinds", 4, 1);
    Fifo<YuvaPixel> coded("coded", 64, 1);
    Fifo<MemoryWord> words("words", 32, 1);
    Fifo<YuvaPixel> out("out", 256, 1);
    TexelMerge block({.kinds = kinds, .coded = coded, .raw_words = words, .out = out});
    Bench bench({&kinds, &coded, &words, &out});
    for (const bool is_coded : {false, true}) {
        put(kinds, {is_coded});
    }
    for (int n = 0; n < 64; ++n) {
        put(coded, {0, n, 1, 2, 3});
    }
    EXPECT_EQ(bench.cycles_until(block, out, 9), -1);  // the raw block is first
    for (std::uint64_t n = 0; n < kRawBlockWords; ++n) {
        put(words, {0x0101010101010101U * (n + 1)});
    }
    EXPECT_EQ(bench.cycles_until(block, out), 4);  // three words
    EXPECT_EQ(out.front().u, 1);
    EXPECT_EQ(out.front().y, 2);
    EXPECT_EQ(out.front().alpha, 3);
    for (int n = 1; n < 8; ++n) EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(bench.cycles_until(block, out), 3);  // two words
    for (int n = 9; n < 16; ++n) EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(bench.cycles_until(block, out), 4);
    for (int n = 17; n < 64; ++n) EXPECT_GE(bench.cycles_until(block, out), 1);
    EXPECT_EQ(words.count(), 0);
    EXPECT_EQ(bench.cycles_until(block, out), 2);  // one to begin the coded block
    for (int n = 1; n < 64; ++n) EXPECT_EQ(bench.cycles_until(block, out), 1);
}

struct CacheBench {
    void texels_of_a_block(int n, std::uint32_t value) {
        for (int i = 0; i < n; ++i) {
            put(texels, {0, value});
        }
    }
    void wait_for(int line, int fills) {
        WaitingSample sample;
        sample.inside = true;
        sample.fx = sample.fy = 4;
        sample.line = {line, line, line, line};
        sample.fills = fills;
        put(in, sample);
    }
    Fifo<WaitingSample> in{"in", 8, 1};
    Fifo<FillTarget> targets{"targets", 4, 1};
    Fifo<RgbaPixel> texels{"texels", 256, 1};
    Fifo<TexelQuad> out{"out", 8, 1};
    TexelCache block{{.in = in, .targets = targets, .texels = texels, .out = out}};
    Bench bench{&in, &targets, &texels, &out};
};

TEST(ParallelTexelTiming, TexelCacheReadsInTheCycleAfterTheLastTexel) {
    CacheBench c;
    c.wait_for(5, 1);
    c.wait_for(5, 0);
    put(c.targets, {5, 0});
    c.texels_of_a_block(63, 7);
    EXPECT_EQ(c.bench.cycles_until(c.block, c.out, 100), -1);
    c.texels_of_a_block(1, 7);
    EXPECT_EQ(c.bench.cycles_until(c.block, c.out), 2);
    EXPECT_EQ(c.bench.cycles_until(c.block, c.out), 1);
    EXPECT_EQ(c.out.front().rgba[3], 7U);
}

TEST(ParallelTexelTiming, TexelCacheWritesNoLineBeforeItsLastReaderHasRead) {
    CacheBench c;
    c.wait_for(5, 0);
    c.wait_for(5, 1);  // waits for its block
    c.wait_for(6, 1);  // waits too; its block goes into a line that the previous sample reads
    put(c.targets, {5, 1});
    put(c.targets, {5, 2});
    c.texels_of_a_block(64, 8);
    c.texels_of_a_block(64, 9);
    EXPECT_EQ(c.bench.cycles_until(c.block, c.out), 1);
    EXPECT_EQ(c.out.front().rgba[0], 0U);
    // The guard of 1 is passed from the next cycle on: 64 texels, then the sample; its block is not the next one's.
    EXPECT_EQ(c.bench.cycles_until(c.block, c.out), 65);
    EXPECT_EQ(c.texels.count(), 64);
    EXPECT_EQ(c.bench.cycles_until(c.block, c.out), 65);
    c.out.pop();
    c.out.commit();
    EXPECT_EQ(c.out.front().rgba[0], 8U);
}

TEST(ParallelTexelTiming, TexelCacheGivesNoTexelsWithoutWeight) {
    CacheBench c;
    put(c.targets, {0, 0});
    c.texels_of_a_block(64, 7);
    for (int n = 0; n < 64; ++n) c.bench.step(c.block);
    for (const bool inside : {false, true}) {
        for (const int fx : {0, 1}) {
            for (const int fy : {0, 1}) {
                WaitingSample sample;
                sample.inside = inside;
                sample.fx = fx;
                sample.fy = fy;
                put(c.in, sample);
                EXPECT_EQ(c.bench.cycles_until(c.block, c.out), 1);
                const auto texel = [&](bool has_weight) { return inside && has_weight ? 7U : 0U; };
                const std::array<std::uint32_t, 4> expected = {texel(true), texel(fy > 0), texel(fx > 0),
                                                               texel(fx > 0 && fy > 0)};
                EXPECT_EQ(c.out.front().rgba, expected);
                c.out.pop();
                c.out.commit();
            }
        }
    }
}

TEST(ParallelTexelTiming, TexelCacheComparesGuardsModulo1024) {
    for (const int samples_read : {0, 1, 511, 512, 513, 1023, 1024, 3000}) {
        for (const int ahead : {-512, -511, -1, 0, 1, 2, 510, 511}) {
            CacheBench c;
            for (int n = 0; n < samples_read; ++n) {
                put(c.in, {});
                ASSERT_EQ(c.bench.cycles_until(c.block, c.out), 1);
                c.out.pop();
                c.out.commit();
            }
            c.texels_of_a_block(64, 8);
            put(c.targets, {5, static_cast<std::uint32_t>(samples_read + ahead) % kSampleNumbers});
            c.wait_for(5, 1);
            EXPECT_EQ(c.bench.cycles_until(c.block, c.out, 100), ahead <= 0 ? 65 : -1) << samples_read << ' ' << ahead;
        }
    }
}

}  // namespace
}  // namespace rs::engine::model
