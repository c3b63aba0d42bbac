// Latency and throughput of the decompression blocks: results appear exactly on time, not a cycle early.

#include "engine/model/limits/coded_layout.hpp"
#include "tests/engine/model/blocks/block_bench.hpp"
#include "tests/engine/model/coded_test_objects.hpp"

namespace rs::engine::model {
namespace {

using test::Bench;
using test::put;

// A view of an object of 12 views with known classes.
struct CodedRegisters {
    CodedRegisters()
        : object(rs::test::ring_object({.views = 12, .width = 80, .height = 70})), board(test::compressed()) {
        std::mt19937_64 random(5);
        object = test::with_coded(object, test::random_images(object, random));
        slot = *board.place(object);
        file = board.top().registers;
        file.banks[0].views = {*board.view(slot, *prepare_view(object, test::upright_at(0.4, 3.5, 0, 0.9, 9, 41)))};
        auto& classes = file.objects[static_cast<std::size_t>(slot)].classes;
        classes[0][1] = {false, false, 1, 0};  // 4 bytes
        classes[0][2] = {false, true, 2, 4};   // 3 + 2 + 16 + 4 -> 26 bytes
        classes[1][3] = {true, false, 2, 1};   // 8 bytes
    }
    RaySpaceObject object;
    Board board;
    RegisterFile file;
    int slot = 0;
};

BlockRequest request_of(int block_row, bool first) {
    return {0, first, true, 2, 40, block_row, 0xFF};
}

TEST(CodedBlockTiming, BlockScanOutputsAPixelPerCycleAndARequestAfterItsRun) {
    const CodedRegisters r;
    Fifo<ColumnWalk> in("in", 4, 1);
    Fifo<BlockRequest> asks("asks", 16, 1);
    Fifo<CodedPixel> pixels("pixels", 64, 1);
    BlockScan block(r.file, {.in = in, .asks = asks, .pixels = pixels});
    Bench bench({&in, &asks, &pixels});
    put(in, {0, true, 2, 40, std::int64_t{5} << 16, 1 << 16});  // rows 5 .. 45
    EXPECT_EQ(bench.cycles_until(block, pixels), 2);
    for (int n = 1; n < 3; ++n) EXPECT_EQ(bench.cycles_until(block, pixels), 1);
    EXPECT_EQ(asks.count(), 0);  // rows 5, 6 and 7 are scanned
    bench.step(block);
    ASSERT_EQ(asks.count(), 1);
    EXPECT_EQ(asks.front().rows, 0b11100000U);
    EXPECT_EQ(asks.front().block_row, 0);
    EXPECT_TRUE(asks.front().first);
    for (int n = 4; n < 42; ++n) EXPECT_EQ(bench.cycles_until(block, pixels), 1);
    EXPECT_EQ(bench.cycles_until(block, pixels, 20), -1);  // 41 rows and an empty one
    EXPECT_EQ(asks.count(), 6);                            // blocks 0 .. 5
    EXPECT_EQ(in.count(), 0);
}

TEST(CodedBlockTiming, BlockScanEndsARunAfterSixteenPixels) {
    const CodedRegisters r;
    Fifo<ColumnWalk> in("in", 4, 1);
    Fifo<BlockRequest> asks("asks", 16, 1);
    Fifo<CodedPixel> pixels("pixels", 64, 1);
    BlockScan block(r.file, {.in = in, .asks = asks, .pixels = pixels});
    Bench bench({&in, &asks, &pixels});
    put(in, {0, true, 2, 40, std::int64_t{9} << 16, 0});  // row 9, for 41 pixels
    for (int n = 0; n < 17; ++n) bench.step(block);
    EXPECT_EQ(asks.count(), 0);
    bench.step(block);
    EXPECT_EQ(asks.count(), 1);
    for (int n = 0; n < 40; ++n) bench.step(block);
    EXPECT_EQ(asks.count(), 3);  // 16 + 16 + 9
    int begins = 0;
    while (pixels.can_pop()) {
        begins += pixels.pop().begins ? 1 : 0;
        pixels.commit();
    }
    EXPECT_EQ(begins, 3);
}

TEST(CodedBlockTiming, TileFinderTakesABlockPerCycleAndRequestsOncePerTile) {
    const CodedRegisters r;
    Fifo<BlockRequest> in("in", 8, 1);
    Fifo<MemoryRead> reads("reads", 8, 1);
    Fifo<FoundTile> out("out", 8, 1);
    TileFinder block(0, r.file, {.in = in, .requests = reads, .out = out});
    Bench bench({&in, &reads, &out});
    const std::pair<int, bool> asked[] = {{2, true}, {3, false}, {4, false}, {4, true}};
    for (const auto& [block_row, first] : asked) {
        put(in, request_of(block_row, first));
    }
    for (int n = 0; n < 4; ++n) EXPECT_EQ(bench.cycles_until(block, out), 1);
    const ObjectRegisters& object = r.file.objects[0];
    ASSERT_EQ(reads.count(), 3);  // the second block is in the tile of the first; a new column starts without a tile
    const int column = (2 * object.tile_columns + 1) * object.table_pitch / 2;
    EXPECT_EQ(reads.front().address, object.tile_table + static_cast<WordAddress>(column));
    EXPECT_FALSE(out.pop().same);
    out.commit();
    EXPECT_TRUE(out.pop().same);
    out.commit();
    EXPECT_TRUE(out.front().high);  // tile row 1
}

TEST(CodedBlockTiming, TileReaderRequestsInTheCycleOfTheWord) {
    Fifo<FoundTile> in("in", 4, 1);
    Fifo<MemoryWord> words("words", 4, 1);
    Fifo<MemoryRead> reads("reads", 4, 1);
    Fifo<RequestedTile> out("out", 4, 1);
    TileReader block(0, {.in = in, .entries = words, .requests = reads, .out = out});
    Bench bench({&in, &words, &reads, &out});
    for (const FoundTile& found :
         {FoundTile{{}, false, true}, FoundTile{{}, true, false}, FoundTile{{}, false, false}}) {
        put(in, found);
    }
    EXPECT_EQ(bench.cycles_until(block, out, 9), -1);
    put(words, {(std::uint64_t{777} << 32U) | 5U});
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    ASSERT_EQ(reads.count(), 1);
    EXPECT_EQ(reads.front().address, 777U);
    EXPECT_EQ(bench.cycles_until(block, out), 1);  // the same tile: no word
    EXPECT_EQ(bench.cycles_until(block, out, 9), -1);
    put(words, {kNoTile});
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(reads.count(), 1);
}

TEST(CodedBlockTiming, RecordReaderTakesACyclePerWordAndOneForANewTile) {
    const CodedRegisters r;
    Fifo<RequestedTile> in("in", 8, 1);
    Fifo<MemoryWord> heads("heads", 4, 1);
    Fifo<MemoryRead> reads("reads", 16, 1);
    Fifo<RequestedRecord> out("out", 8, 1);
    RecordReader block(0, r.file, {.in = in, .heads = heads, .requests = reads, .out = out});
    Bench bench({&in, &heads, &reads, &out});
    // Column 40 is the second block of a tile: blocks 4 .. 7 of classes 1, 2, 0, 1.
    const std::uint64_t classes = (std::uint64_t{1} << 12U) | (std::uint64_t{2} << 15U) | (std::uint64_t{1} << 21U);
    put(heads, {classes | std::uint64_t{0xFFFF} << 48U});
    put(in, {request_of(0, true), RequestedTile::Kind::read, 1000});
    for (int row = 1; row < 4; ++row) {
        put(in, {request_of(row, false), RequestedTile::Kind::same, 0});
    }
    EXPECT_EQ(bench.cycles_until(block, out), 2);
    EXPECT_EQ(reads.count(), 1);
    EXPECT_EQ(bench.cycles_until(block, out), 1);  // 26 bytes from byte 4: four words
    EXPECT_EQ(bench.cycles_until(block, out), 4);  // class 0
    EXPECT_EQ(reads.count(), 5);
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    const WordAddress expected[] = {1001, 1001, 1002, 1003, 1004, 1004};
    for (const WordAddress address : expected) {
        EXPECT_EQ(reads.pop().address, address);
        reads.commit();
    }
    const int lanes[] = {0, 4, 0, 6};
    const int words[] = {1, 4, 0, 2};
    for (int n = 0; n < 4; ++n) {
        const RequestedRecord record = out.pop();
        out.commit();
        EXPECT_EQ(record.lane, lanes[n]);
        EXPECT_EQ(record.words, words[n]);
    }
}

TEST(CodedBlockTiming, BlockMotionTakesACyclePerWordOneForOutputAndOneForASecondRequest) {
    const CodedRegisters r;
    Fifo<RequestedRecord> in("in", 4, 1);
    Fifo<MemoryWord> words("words", 4, 1);
    Fifo<BlockRecord> out("out", 4, 1);
    Fifo<BlockRequest> asks("asks", 4, 1);
    BlockMotion block(0, r.file, {.in = in, .words = words, .out = out, .asks = &asks});
    Bench bench({&in, &words, &out, &asks});
    RequestedRecord asked{request_of(2, true), 3, true, {7, 9}, 6, 2};
    put(in, asked);
    for (const std::uint64_t word :
         {std::uint64_t{codec::board_motion_word({1, -3, 4})} << 48U, std::uint64_t{0x060504030201}}) {
        put(words, {word});
    }
    EXPECT_EQ(bench.cycles_until(block, out), 3);
    ASSERT_EQ(asks.count(), 1);
    EXPECT_EQ(asks.front().image, 9);
    EXPECT_EQ(asks.front().column, 37);
    EXPECT_EQ(asks.front().block_row, 2);
    EXPECT_EQ(asks.front().rows, 0xF0U);
    EXPECT_TRUE(asks.front().first);
    EXPECT_EQ(bench.cycles_until(block, asks), 1);
    EXPECT_EQ(out.front().block[1], 2);
    EXPECT_EQ(out.front().quarter[0][3], 6);
    asked.class_number = asked.words = 0;  // an empty block
    put(in, asked);
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(asks.count(), 2);
}

TEST(CodedBlockTiming, RecordSelectGivesAPixelPerCycle) {
    const CodedRegisters r;
    Fifo<CodedPixel> in("in", 16, 1);
    Fifo<BlockRecord> records("records", 4, 1);
    Fifo<CodedPixel> out("out", 16, 1);
    RecordSelect block(0, r.file, {.in = in, .records = records, .out = out});
    Bench bench({&in, &records, &out});
    for (int row = 6; row < 10; ++row) {
        CodedPixel pixel;
        pixel.is_visible = pixel.pending = true;
        pixel.begins = row == 6;
        pixel.row = row;
        put(in, pixel);
    }
    BlockRecord record;
    record.flat = {1, 2, 3};
    put(records, record);
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(bench.cycles_until(block, out, 9), -1);  // row 8 is in the next block
    record.block_row = 1;
    put(records, record);
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(records.count(), 0);
}

TEST(CodedBlockTiming, BookLookupLoadsAWordPerCycleThenGivesAPixelPerCycleOfLatencySeven) {
    const CodedRegisters r;
    Fifo<CodedPixel> in("in", 8, 1);
    Fifo<MemoryRead> reads("reads", 4, 1);
    Fifo<MemoryWord> words("words", 4, 1);
    Fifo<YuvaPixel> out("out", 8, 1);
    BookLookup block(r.file, {.in = in, .requests = reads, .words = words, .out = out});
    Bench bench({&in, &reads, &words, &out});
    CodedPixel pixel;
    pixel.is_visible = true;
    pixel.hops = 1;
    put(in, pixel);
    const auto all = static_cast<std::uint64_t>(r.file.objects[0].book_words);
    std::uint64_t steps = 0;
    std::uint64_t answered = 0;
    for (; answered < all; ++steps) {
        if (reads.can_pop()) {
            reads.pop();
            words.push({0});
            ++answered;
        }
        bench.step(block);
    }
    EXPECT_EQ(steps, all + 1);
    bench.step(block);  // the last word
    EXPECT_EQ(out.count(), 0);
    EXPECT_EQ(bench.cycles_until(block, out), 7);
    pixel.hops = 2;  // one prediction
    put(in, pixel);
    EXPECT_EQ(bench.cycles_until(block, out), 7);
    for (const int hops : {4, 1}) {
        pixel.hops = hops;
        put(in, pixel);
    }
    EXPECT_EQ(bench.cycles_until(block, out), 9);  // three predictions
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(block.book_loads(), 1U);
}

// Bits of the codebook banks, as in DIAGRAM.md.
TEST(CodedBlockTiming, TheBanksHaveTheBitsOfTheDiagram) {
    EXPECT_EQ(BookBanks::kBits, 1'605'632U);
}

}  // namespace
}  // namespace rs::engine::model
