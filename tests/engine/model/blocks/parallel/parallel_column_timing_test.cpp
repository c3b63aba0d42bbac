// Latency and throughput of the column set-up blocks of a parallel board: results appear exactly on time, not a cycle
// early.

#include "engine/core/definition/fixed_point.hpp"
#include "engine/model/blocks/parallel/band_reader.hpp"
#include "engine/model/blocks/parallel/bracket_finder.hpp"
#include "engine/model/blocks/parallel/column_setup.hpp"
#include "engine/model/blocks/parallel/image_reader.hpp"
#include "engine/model/limits/parallel_layout.hpp"
#include "engine/model/signals/arithmetic.hpp"
#include "tests/engine/model/blocks/block_bench.hpp"
#include "tests/engine/model/parallel_test_objects.hpp"

namespace rs::engine::model {
namespace {

using test::Bench;
using test::put;

struct ColumnRegisters {
    explicit ColumnRegisters(bool shape, int width = 48)
        : object(test::any_object({.views = 8, .planes = 4, .x_cells = 16, .u_cells = 16}, {.shape = shape})),
          board(test::parallel(1)) {
        if (shape) object.rings.front().shape = rs::test::small_shape(object, 0);
        slot = *board.place(object);
        file = board.top().registers;
        file.banks[0].views = {*board.view(slot, *prepare_view(object, test::upright_at(0.4, 3.5, 0, 0.9, width, 20),
                                                               engine::TexelFilter::kBilinear))};
    }
    RaySpaceObject object;
    Board board;
    RegisterFile file;
    int slot = 0;
};

// Answers every request a cycle later with word(address); returns the number of cycles until `out` has one more item.
template <class Word>
int cycles_until_answered(Bench& bench, Block& block, Fifo<MemoryRead>& reads, Fifo<MemoryWord>& words,
                          const FifoState& out, const Word& word) {
    for (int n = 1; n < 400; ++n) {
        const int before = out.count();
        bench.step(block);
        if (out.count() > before) return n;
        if (reads.can_pop()) words.push({word(reads.pop().address)});
        reads.commit();
        words.commit();
    }
    return -1;
}

TEST(ParallelArithmetic, SquareRootsEqualTheDefinition) {
    std::mt19937_64 random(3);
    for (int n = 0; n < 20'000; ++n) {
        const std::uint64_t square = random() >> (1 + random() % 63);
        EXPECT_EQ(square_root_serially(square), floor_square_root(static_cast<std::int64_t>(square))) << square;
    }
    const std::uint64_t most = (std::uint64_t{1} << 63) - 1;
    EXPECT_EQ(square_root_serially(most), 3'037'000'499);
    EXPECT_EQ(square_root_serially(0), 0);
}

TEST(ParallelColumnTiming, BracketFinderReadsAWordPerLookAndPerCrossing) {
    const ColumnRegisters r(true);
    Fifo<MappedRay> in("in", 4, 1);
    Fifo<MemoryRead> reads("reads", 2, 1);
    Fifo<MemoryWord> words("words", 2, 1);
    Fifo<BracketedRay> out("out", 4, 1);
    BracketFinder block(r.file, {.in = in, .requests = reads, .answers = words, .out = out});
    Bench bench({&in, &reads, &words, &out});
    put(in, {0, false, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(out.pop().kind, RayKind::none);
    out.commit();
    // The crossing of image n is n * 1000 (u = 0), every gap has 3 lines from 3 n on.
    const WordAddress lines = r.file.objects[0].lines;
    const auto word = [&](WordAddress address) {
        const auto n = static_cast<std::uint64_t>(address - lines) / static_cast<std::uint64_t>(record_words(4));
        const auto at = static_cast<int>((address - lines) % static_cast<WordAddress>(record_words(4)));
        return at == 2 ? std::uint64_t{3 | 2 << 16} | (3 * n) << 32U : n * 1000;
    };
    put(in, {0, true, 1, 3400, 7, 3, 0, 1 << 28, 0});
    // Crossing of 3: request, take, 9; gap 3: request, take; crossing of 4: request, take, 9; decide.
    EXPECT_EQ(cycles_until_answered(bench, block, reads, words, out, word), 11 + 2 + 11 + 1);
    BracketedRay found = out.pop();
    out.commit();
    EXPECT_EQ(found.kind, RayKind::shape);
    EXPECT_EQ(found.first, 3);
    EXPECT_EQ(found.second, 4);
    EXPECT_EQ(found.from_first_q20, 400);
    EXPECT_EQ(found.width_q20, 1000);
    EXPECT_EQ(found.lines, 3);
    EXPECT_EQ(found.first_line, 9);
    EXPECT_FALSE(found.lines_before);
    EXPECT_TRUE(found.lines_behind);
    in.push(
        {0, true, 1, 3400, 7, 5, 0, 1 << 28, 0});  // two gaps too far: the crossing of 5 serves as the second of gap 4
    in.commit();
    EXPECT_EQ(cycles_until_answered(bench, block, reads, words, out, word), 11 + (2 + 11 + 1) + (2 + 11 + 1));
    found = out.pop();
    out.commit();
    EXPECT_EQ(found.first, 3);
    put(in, {0, true, 1, 3400, 7, 3, 0, 1 << 28, 0});
    const auto no_lines = [&](WordAddress address) {
        return word(address) == (3U | 2U << 16U | std::uint64_t{9} << 32U) ? 3U << 16U : word(address);
    };
    EXPECT_EQ(cycles_until_answered(bench, block, reads, words, out, no_lines), 11 + 2 + 1);
    EXPECT_EQ(out.pop().kind, RayKind::foot);
}

TEST(ParallelColumnTiming, RaysOfPlaneObjectsPassTheBracketFinder) {
    const ColumnRegisters r(false);
    Fifo<MappedRay> in("in", 4, 1);
    Fifo<MemoryRead> reads("reads", 2, 1);
    Fifo<MemoryWord> words("words", 2, 1);
    Fifo<BracketedRay> out("out", 4, 1);
    BracketFinder block(r.file, {.in = in, .requests = reads, .answers = words, .out = out});
    Bench bench({&in, &reads, &words, &out});
    put(in, {0, true, 1, 3400, 7, 3, 0, 0, 0});
    EXPECT_EQ(bench.cycles_until(block, out), 1);
    EXPECT_EQ(out.front().kind, RayKind::plane);
    EXPECT_EQ(out.front().first, 3);
}

TEST(ParallelColumnTiming, ImageReaderRequestsAWordPerCycle) {
    const ColumnRegisters r(true);
    Fifo<BracketedRay> in("in", 4, 1);
    Fifo<MemoryRead> reads("reads", 2, 1);
    Fifo<MemoryWord> words("words", 2, 1);
    Fifo<RayWithLines> out("out", 4, 1);
    ImageReader block(r.file, {.in = in, .requests = reads, .answers = words, .out = out});
    Bench bench({&in, &reads, &words, &out});
    const WordAddress lines = r.file.objects[0].lines;
    const auto word = [&](WordAddress address) { return std::uint64_t{address - lines} * 0x100000001U; };
    const std::pair<RayKind, int> kinds[] = {
        {RayKind::none, 1}, {RayKind::plane, 9 + 4 + 2}, {RayKind::foot, 9 + 5 + 2}, {RayKind::shape, 9 + 10 + 2}};
    for (const auto& [kind, cycles] : kinds) {
        BracketedRay ray;
        ray.kind = kind;
        ray.plane = 2;
        ray.first = 1;
        ray.second = 5;
        put(in, ray);
        EXPECT_EQ(cycles_until_answered(bench, block, reads, words, out, word), cycles);
        if (kind == RayKind::shape) {
            EXPECT_EQ(out.front().image[0].fl_y_q16, record_words(4) + 1);
            EXPECT_EQ(out.front().image[1].l2_q30, 5 * record_words(4) + plane_words(2) + 2);
        }
        out.pop();
        out.commit();
    }
}

TEST(ParallelColumnTiming, ColumnSetupTakesTheCyclesOfItsSchedule) {
    const ColumnRegisters r(true);
    Fifo<RayWithLines> in("in", 4, 1);
    Fifo<ColumnSetup> out("out", 4, 1);
    ColumnSetupStage block(r.file, {.in = in, .out = out});
    Bench bench({&in, &out});
    RayWithLines ray;
    put(in, ray);
    EXPECT_EQ(bench.cycles_until(block, out), 2);  // no ray
    ray.ray.kind = RayKind::shape;
    ray.ray.n_q28 = 1 << 28;
    ray.ray.t_q28 = 1 << 26;
    ray.ray.from_first_q20 = 1000;
    ray.ray.width_q20 = 4000;
    ray.ray.lines = 2;
    ray.ray.first_line = 5;
    put(in, ray);
    EXPECT_EQ(ColumnSetupStage::kShapeLatency, 159);
    EXPECT_EQ(bench.cycles_until(block, out), 159);
    out.pop();
    out.commit();
    EXPECT_EQ(out.front().weight, 64);
    // A quarter of two lines, so in the middle of the first; p 0, in the middle of nine cells.
    EXPECT_EQ(out.front().map_line, (std::array<std::int64_t, 2>{5, 6}));
    EXPECT_EQ(out.front().line_part, 0);
    EXPECT_EQ(out.front().map_place, (std::array<int, 2>{4, 5}));
    EXPECT_EQ(out.front().p_part, 0);
    ray.ray.n_q28 = 1 << 24;  // the foot is 2^9 radii away
    ray.ray.t_q28 = 0;
    RegisterFile far = r.file;
    far.banks[0].views[0].planes[0].c_q20 = (1 << 28) - 1;
    Fifo<RayWithLines> far_in("in", 4, 1);
    ColumnSetupStage far_block(far, {.in = far_in, .out = out});
    Bench far_bench({&far_in, &out});
    put(far_in, ray);
    EXPECT_EQ(far_bench.cycles_until(far_block, out), ColumnSetupStage::kTooFarLatency);
    ray.ray.kind = RayKind::plane;
    ray.image[0].l0_q20 = 3 << 20;
    ray.image[0].fl_y_q16 = 60 << 16;
    ray.image[0].cx_q16 = 20 << 16;
    put(in, ray);
    EXPECT_EQ(bench.cycles_until(block, out), VerticalCompensation::kLatency);
}

// Lines before the first and after the last line of a gap are those of the neighbouring gaps, or the gap's own if those
// have none.
TEST(ParallelColumnTiming, ColumnSetupFindsTheLinesBesideTheRayInNeighbouringGapsToo) {
    const ColumnRegisters r(true);
    const ObjectRegisters& object = r.file.objects[static_cast<std::size_t>(r.slot)];
    const auto lines_at = [&](int from_first, std::int64_t first_line, int lines, bool before, bool behind) {
        RayWithLines ray;
        ray.ray.kind = RayKind::shape;
        ray.ray.n_q28 = 1 << 28;
        ray.ray.from_first_q20 = from_first;
        ray.ray.width_q20 = 3200;
        ray.ray.lines = lines;
        ray.ray.first_line = first_line;
        ray.ray.lines_before = before;
        ray.ray.lines_behind = behind;
        ColumnSetup out;
        EXPECT_TRUE(set_up_shape_column(r.file.banks[0].views[0], object, ray, out));
        return std::array<std::int64_t, 3>{out.map_line[0], out.map_line[1], out.line_part};
    };
    using Lines = std::array<std::int64_t, 3>;
    const std::int64_t all = object.shape.lines;
    EXPECT_EQ(lines_at(0, 5, 2, true, true), (Lines{4, 5, 4}));
    EXPECT_EQ(lines_at(0, 5, 2, false, true), (Lines{5, 5, 4}));
    EXPECT_EQ(lines_at(0, 0, 2, true, true), (Lines{all - 1, 0, 4}));
    EXPECT_EQ(lines_at(3199, 5, 2, true, true), (Lines{6, 7, 3}));
    EXPECT_EQ(lines_at(3199, 5, 2, true, false), (Lines{6, 6, 3}));
    EXPECT_EQ(lines_at(3199, all - 2, 2, true, true), (Lines{all - 1, 0, 3}));
    EXPECT_EQ(lines_at(1600, 5, 2, true, true), (Lines{5, 6, 4}));
}

TEST(ParallelColumnTiming, BandReaderRequestsAWordPerCycleAndWaitsForAStripe) {
    const ColumnRegisters r(true);  // 48 columns
    Fifo<ColumnSetup> in("in", 64, 1);
    Fifo<Done> stripe_free("free", 2, 1);
    Fifo<MemoryRead> reads("reads", 64, 1);
    Fifo<ColumnSetup> rise("rise", 64, 1);
    Fifo<ColumnSetup> march("march", 64, 1);
    Fifo<ColumnSetup> place("place", 64, 1);
    BandReader block(r.file, {},
                     {.in = in,
                      .stripe_free = stripe_free,
                      .requests = reads,
                      .to_rise = rise,
                      .to_march = march,
                      .to_place = place});
    Bench bench({&in, &stripe_free, &reads, &rise, &march, &place});
    ColumnSetup column;
    column.kind = RayKind::shape;
    column.map_line = {1, 4};
    column.map_place = {2, 3};
    put(in, column);
    EXPECT_EQ(bench.cycles_until(block, march), 19);
    EXPECT_EQ(rise.count(), 1);
    EXPECT_EQ(place.count(), 1);
    // 9 places of 7 bands, stored in 2 words each.
    for (int n = 0; n < 8; ++n) EXPECT_EQ(bench.cycles_until(block, reads), 1);
    EXPECT_EQ(bench.cycles_until(block, reads, 5), -1);
    for (const int word : {22, 76, 23, 77, 24, 78, 25, 79}) {
        EXPECT_EQ(reads.pop().address, r.file.objects[0].shape.cells + static_cast<WordAddress>(word));
        reads.commit();
    }
    // A ray beside the same cells, at another position between them, requests nothing; a ray beside other cells does.
    EXPECT_FALSE(march.pop().same_cells);
    march.commit();
    column.line_part = 3;
    put(in, column);
    EXPECT_EQ(bench.cycles_until(block, march), 19);
    EXPECT_EQ(bench.cycles_until(block, reads, 9), -1);
    EXPECT_TRUE(march.pop().same_cells);
    march.commit();
    column.map_line = {1, 5};
    put(in, column);
    EXPECT_EQ(bench.cycles_until(block, march), 19);
    for (int n = 0; n < 8; ++n) EXPECT_EQ(bench.cycles_until(block, reads), 1);
    EXPECT_FALSE(march.pop().same_cells);
    march.commit();
    column.kind = RayKind::none;
    for (int n = 3; n < 48; ++n) {
        put(in, column);
    }
    for (int n = 3; n < 32; ++n) EXPECT_EQ(bench.cycles_until(block, march), 1);
    EXPECT_EQ(bench.cycles_until(block, march, 50), -1);  // two stripes are in flight
    put(stripe_free, {});
    EXPECT_EQ(bench.cycles_until(block, march), 1);
    EXPECT_EQ(march.count(), 30);
}

}  // namespace
}  // namespace rs::engine::model
