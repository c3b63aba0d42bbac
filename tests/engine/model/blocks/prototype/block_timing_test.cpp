// Latency, throughput and interval of each block: results appear exactly on time, not a cycle early.

#include "tests/engine/model/blocks/block_bench.hpp"
#include "tests/engine/model/board_test_objects.hpp"

namespace rs::engine::model {
namespace {

using test::Bench;
using test::put;

// A view of an object, in a register file.
struct PlaneRegisters {
    PlaneRegisters() : object(rs::test::ring_object({.views = 12, .planes = 12})), board(test::prototype()) {
        slot = *board.place(object);
        const auto prepared = prepare_view(object, test::upright_at(0.4, 3.5, 0, 0.9, 9, 7));
        file = board.top().registers;
        file.banks[0].views = {*board.view(slot, *prepared)};
    }
    RaySpaceObject object;
    Board board;
    RegisterFile file;
    int slot = 0;
};

TEST(BlockTiming, RasterGeneratorMakesAColumnInPlanesPlusOneCycles) {
    const PlaneRegisters r;
    Fifo<ViewJob> jobs("jobs", 2, 4);
    Fifo<ColumnRay> columns("columns", 20, 72);
    RasterGenerator block(r.file, {}, {.jobs = jobs, .columns = columns});
    Bench bench({&jobs, &columns});
    put(jobs, {0});
    EXPECT_EQ(bench.cycles_until(block, columns), 1 + 12 + 1);
    for (int column = 1; column < 9; ++column) EXPECT_EQ(bench.cycles_until(block, columns), 13);
    EXPECT_EQ(bench.cycles_until(block, columns, 40), -1);  // the view has 9 columns
}

// Measures the latency of a stage with one item, then the interval with two items.
template <class Stage, class In, class Out>
void expect_latency(const RegisterFile& file, const In& item, int latency, bool has_ray) {
    Fifo<In> in("in", 4, 1);
    Fifo<Out> out("out", 4, 1);
    Stage stage(file, {.in = in, .out = out});
    Bench bench({&in, &out});
    put(in, item);
    EXPECT_EQ(bench.cycles_until(stage, out), latency);
    EXPECT_EQ(out.front().has_ray, has_ray);
    for (int n = 0; n < 2; ++n) {
        put(in, item);
    }
    EXPECT_EQ(bench.cycles_until(stage, out), latency);
    EXPECT_EQ(bench.cycles_until(stage, out), latency);
}

// Columns of the view from the raster generator.
std::vector<ColumnRay> columns_of(const RegisterFile& file) {
    Fifo<ViewJob> jobs("jobs", 2, 4);
    Fifo<ColumnRay> columns("columns", 20, 72);
    RasterGenerator block(file, {}, {.jobs = jobs, .columns = columns});
    Bench bench({&jobs, &columns});
    put(jobs, {0});
    std::vector<ColumnRay> all;
    while (all.size() < 9) {
        if (columns.can_pop()) all.push_back(columns.pop());
        bench.step(block);
    }
    return all;
}

TEST(BlockTiming, RayPosition) {
    const PlaneRegisters r;
    const ColumnRay middle = columns_of(r.file)[4];
    ASSERT_TRUE(middle.has_ray);
    expect_latency<RayPosition, ColumnRay, RayPoint>(r.file, middle, 75, true);
    ColumnRay beside = middle;
    beside.t_q28 = middle.n_q28 * 2 - 1;  // u nearly 2
    expect_latency<RayPosition, ColumnRay, RayPoint>(r.file, beside, 46, false);
    expect_latency<RayPosition, ColumnRay, RayPoint>(r.file, ColumnRay{}, 2, false);
}

TEST(BlockTiming, VerticalCompensationAndColumnAddress) {
    const PlaneRegisters r;
    const CapturedView& view = r.object.views[0];
    RayLine line{0, true, 0, 3 << 20, 0, view.cx_q16, view.cy_q16, view.fl_y_q16, view.height_q20, 3 << 20, 0, 0, 0};
    expect_latency<VerticalCompensation, RayLine, ColumnWalk>(r.file, line, 65, true);
    RayLine outside = line;
    outside.cx_q16 = -(1 << 16);
    expect_latency<VerticalCompensation, RayLine, ColumnWalk>(r.file, outside, 57, false);
    RayLine near = line;
    near.l0_q20 = (1 << 17) - 1;
    expect_latency<VerticalCompensation, RayLine, ColumnWalk>(r.file, near, 12, false);
    near.l0_q20 = 1 << 17;  // at the limit: far enough
    near.fl_y_q16 = 1 << 20;
    expect_latency<VerticalCompensation, RayLine, ColumnWalk>(r.file, near, 65, true);
    expect_latency<VerticalCompensation, RayLine, ColumnWalk>(r.file, RayLine{}, 2, false);
    expect_latency<ColumnAddress, ColumnWalk, PlacedColumn>(r.file, {0, true, 3, 4, 0, 0}, 48, true);
    expect_latency<ColumnAddress, ColumnWalk, PlacedColumn>(r.file, ColumnWalk{}, 2, false);
}

TEST(BlockTiming, RowScanGivesAPairEverySecondCycleAndOneMoreForAnOddRow) {
    const PlaneRegisters r;
    Fifo<PlacedColumn> in("in", 4, 1);
    Fifo<PixelPair> out("out", 8, 1);
    RowScan block(r.file, {.in = in, .out = out});
    Bench bench({&in, &out});
    put(in, {0, true, 0, 1 << 16, 10, 20, 30});
    EXPECT_EQ(bench.cycles_until(block, out), 3);  // the column, two pixels
    for (int pair = 1; pair < 4; ++pair) EXPECT_EQ(bench.cycles_until(block, out), 2);
    EXPECT_EQ(bench.cycles_until(block, out, 20), -1);  // 7 rows: four pairs
    for (int pair = 0; pair < 4; ++pair) {
        const PixelPair p = out.pop();
        out.commit();
        EXPECT_TRUE(p.is_visible[0]);
        EXPECT_EQ(p.row[0], 2 * pair);
        EXPECT_EQ(p.is_visible[1], pair < 3);
    }
}

TEST(BlockTiming, SampleFetchTakesFiveSlotsAndSixAcrossAlphaWords) {
    Fifo<PixelPair> in("in", 4, 1);
    Fifo<MemoryRead> reads("reads", 16, 1);
    Fifo<SampleTag> tags("tags", 16, 1);
    SampleFetch block({.in = in, .requests = reads, .tags = tags});
    Bench bench({&in, &reads, &tags});
    put(in, {0, {true, true}, {30, 31}, 100, 200, 300});
    put(in, {0, {true, true}, {31, 32}, 100, 200, 300});
    for (int n = 0; n < 5; ++n) bench.step(block);
    EXPECT_EQ(in.count(), 1);
    EXPECT_EQ(reads.count(), 5);
    for (int n = 0; n < 5; ++n) bench.step(block);
    EXPECT_EQ(in.count(), 1);
    bench.step(block);
    EXPECT_EQ(in.count(), 0);
    EXPECT_EQ(reads.count(), 11);
    const WordAddress expected[] = {300, 203, 103, 203, 103, 300, 301, 203, 103, 204, 104};
    for (const WordAddress address : expected) {
        EXPECT_EQ(reads.pop().address, address);
        reads.commit();
    }
}

TEST(BlockTiming, ColourConversionHasLatencyFiveAndAPixelPerCycle) {
    Fifo<YuvaPixel> in("in", 8, 1);
    Fifo<RgbaPixel> out("out", 8, 1);
    ColourConversion block({.in = in, .out = out});
    Bench bench({&in, &out});
    for (int n = 0; n < 3; ++n) {
        put(in, {0, 10 * n, 128, 128, 255});
    }
    EXPECT_EQ(bench.cycles_until(block, out), 5);
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(bench.cycles_until(block, out, 20), -1);
}

TEST(BlockTiming, ImageWriterPacksTwoPixels) {
    const PlaneRegisters r;
    Fifo<RgbaPixel> in("in", 8, 1);
    Fifo<MemoryWrite> out("out", 8, 1);
    ImageWriter block(r.file, {.in = in, .out = out});
    Bench bench({&in, &out});
    for (std::uint32_t n = 1; n <= 4; ++n) {
        put(in, {0, n});
    }
    EXPECT_EQ(bench.cycles_until(block, out), 2);
    EXPECT_EQ(bench.cycles_until(block, out), 2);
    EXPECT_EQ(out.front().data, (std::uint64_t{2} << 32) | 1U);
    EXPECT_EQ(out.front().address, r.file.images);
    EXPECT_FALSE(out.front().last);
}

TEST(BlockTiming, MapReaderRequestsOnceAndOutputsTheByte) {
    Fifo<RayPoint> in("in", 2, 1);
    Fifo<MemoryRead> reads("reads", 2, 1);
    Fifo<MemoryWord> words("words", 2, 1);
    Fifo<MappedRay> out("out", 2, 1);
    MapReader block({.in = in, .requests = reads, .answers = words, .out = out});
    Bench bench({&in, &reads, &words, &out});
    put(in, {0, true, 1, 2, 3, 8 * 50 + 3});
    EXPECT_EQ(bench.cycles_until(block, reads), 1);
    EXPECT_EQ(reads.front().address, 50U);
    EXPECT_EQ(bench.cycles_until(block, out, 10), -1);
    put(words, {0xFFFFFFFF'2AFFFFFF});
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(out.front().image, 42);
    EXPECT_TRUE(out.front().has_ray);
    EXPECT_EQ(reads.count(), 1);
}

}  // namespace
}  // namespace rs::engine::model
