// Turns of the cell march: results appear exactly on time, not a cycle early.

#include "engine/model/blocks/parallel/cell_march.hpp"
#include "tests/engine/model/blocks/block_bench.hpp"
#include "tests/engine/model/blocks/pixel_registers.hpp"

namespace rs::engine::model {
namespace {

using test::Bench;
using test::column_of;
using test::pixel_of;
using test::PixelRegisters;
using test::put;

// Column 1, between two equal lines and at the first of two places in p: bands 2 and 6 of seven have a surface at depth
// 100; the object extends to depth 120.
struct MarchBench {
    MarchBench() {
        ShapeRegisters& shape = r.file.objects[static_cast<std::size_t>(r.slot)].shape;
        shape.thickness = 20;
        // The reference viewpoint is distant, and depth 0 is at the foot: bands are linear in depth.
        for (std::size_t d = 0; d < shape.effective_depth_q3.size(); ++d)
            shape.effective_depth_q3[d] = static_cast<std::int16_t>(8 * d);
        put(columns, column_of(RayKind::none, 0));
        put(columns, column_of(RayKind::shape, 1));
        for (int n = 0; n < 2; ++n) bench.step(block);
        for (int n = 0; n < 8; ++n) {  // words 0, 0, 1, 1 of either place
            put(words, {std::uint64_t{packed_cell({100, ShapeCell::kByBoth})} << 32U});
            bench.step(block);
        }
    }
    // A column with surfaces only in band 1, or also the same in band 2: their depths by [p][line].
    void put_band_1(const ColumnSetup& column, const int (&depths)[2][2], bool and_band_2 = false) {
        put(columns, column);
        bench.step(block);
        for (const auto& of_p : depths) {
            for (int word = 0; word < 2; ++word) {
                for (const int depth : of_p) {
                    const ShapeCell cell = {static_cast<std::uint8_t>(depth), ShapeCell::kByBoth};
                    const std::uint64_t band_1 = std::uint64_t{packed_cell(cell)} << 16U;
                    put(words, {word == 0 ? band_1 | (and_band_2 ? band_1 << 16U : 0) : 0});
                    bench.step(block);
                }
            }
        }
    }
    void push(int id, std::int32_t foot_q12, std::int32_t per_d_q20) { put(in, {pixel_of(id), foot_q12, per_d_q20}); }
    PixelRegisters r;
    Fifo<ColumnSetup> columns{"columns", 4, 1};
    Fifo<MemoryWord> words{"words", 4, 1};
    Fifo<PixelBandRay> in{"in", 4, 1};
    Fifo<ReturnedPixel> again{"again", 4, 1};
    Fifo<SurfaceHit> met{"met", 4, 1};
    Fifo<FinishedPixel> empty{"empty", 4, 1};
    CellMarch block{r.file, {.columns = columns, .words = words, .in = in, .again = again, .met = met, .empty = empty}};
    Bench bench{&columns, &words, &in, &again, &met, &empty};
};

// The middle of a band, where only its cell has weight.
constexpr std::int32_t middle_of(int band) {
    return (band << 12) + (1 << 11);
}

TEST(CellMarchTiming, TakesATurnOfTwoLooksInEveryStageOfItsRing) {
    constexpr int kTurn = CellMarch::kStages;
    EXPECT_EQ(kTurn, 12);
    MarchBench m;
    m.push(0, 0, 0);  // no ray
    EXPECT_EQ(m.bench.cycles_until(m.block, m.empty), kTurn + 1);
    m.push(1, middle_of(4), 0);  // bands 4 and 5 are empty
    EXPECT_EQ(m.bench.cycles_until(m.block, m.empty), kTurn + 1);
    EXPECT_EQ(m.block.looks(), 1U);
    m.push(1, middle_of(2), 0);  // band 2 at the foot, and at its depth in another turn
    EXPECT_EQ(m.bench.cycles_until(m.block, m.met), 2 * kTurn + 1);
    EXPECT_TRUE(m.met.front().final);
    EXPECT_EQ(m.met.pop().depth_q3, 800);
    m.met.commit();
    // A band per 64 depths: 9 steps of 28. Looks at depths 14, 42 (near band 2, but before its surface), 70, 98.
    m.push(1, middle_of(1), 1 << 14);
    EXPECT_EQ(m.bench.cycles_until(m.block, m.met), 2 * kTurn + 1);
    EXPECT_EQ(m.block.looks(), 3U + 4U);
    EXPECT_FALSE(m.met.front().final);
    EXPECT_EQ(m.met.front().next.begin, 112);
    EXPECT_EQ(m.met.front().depth_q3, 800);
}

// Rays march concurrently: a turn enters in every cycle.
TEST(CellMarchTiming, GivesAPixelPerCycleOfOneTurn) {
    MarchBench m;
    for (int n = 0; n < 3; ++n) {
        put(m.in, {pixel_of(1 + 16 * n), middle_of(4), 0});
    }
    EXPECT_EQ(m.bench.cycles_until(m.block, m.empty), CellMarch::kStages + 1);
    EXPECT_EQ(m.bench.cycles_until(m.block, m.empty), 1);
    EXPECT_EQ(m.bench.cycles_until(m.block, m.empty), 1);
}

TEST(CellMarchTiming, ReturnedPixelsPrecedeNewOnes) {
    MarchBench m;
    m.push(1, middle_of(1), 1 << 14);
    EXPECT_EQ(m.bench.cycles_until(m.block, m.met), 2 * CellMarch::kStages + 1);
    m.push(17, middle_of(4), 0);
    m.again.push({1, m.met.pop().next});
    m.met.commit();
    m.again.commit();
    // The look behind 112 is at depth 126: the object still goes on there.
    EXPECT_EQ(m.bench.cycles_until(m.block, m.met), CellMarch::kStages + 1);
    EXPECT_EQ(m.met.front().pixel.id, 1);
    EXPECT_EQ(m.met.front().depth_q3, 8 * 112);
    EXPECT_EQ(m.bench.cycles_until(m.block, m.empty), 1);
    EXPECT_EQ(m.empty.front().id, 17);
}

TEST(CellMarchTiming, WaitsForTheLastWordOfItsColumn) {
    MarchBench m;
    put(m.columns, column_of(RayKind::shape, 2));
    m.push(2, middle_of(9), 0);
    for (int n = 0; n < 7; ++n) {
        put(m.words, {0});
        EXPECT_EQ(m.bench.cycles_until(m.block, m.empty, 20), -1);
    }
    put(m.words, {0});
    EXPECT_EQ(m.bench.cycles_until(m.block, m.empty), CellMarch::kStages + 1);
}

// A word of the second line is written as cells, through one of the ports of their memory.
TEST(CellMarchTiming, LooksOnceInACycleThatWritesCells) {
    MarchBench m;
    put(m.columns, column_of(RayKind::shape, 2));
    m.bench.step(m.block);
    put(m.words, {0});
    m.push(1, middle_of(1), 1 << 14);  // the second look is delayed by the word of the second line
    m.bench.step(m.block);
    EXPECT_EQ(m.block.looks(), 2U);
    put(m.words, {0});
    m.push(17, middle_of(1), 1 << 14);
    m.bench.step(m.block);
    EXPECT_EQ(m.block.looks(), 3U);
}

// The stored and interpolated surface of two lines is that of section 6.
TEST(CellMarchTiming, ShowsTheSurfaceBetweenItsCells) {
    MarchBench m;
    ColumnSetup column = column_of(RayKind::shape, 2);
    column.line_part = 2;
    column.p_part = 4;
    m.put_band_1(column, {{100, 108}, {110, 118}});
    const int jump = m.r.file.objects[static_cast<std::size_t>(m.r.slot)].shape.jump;
    EXPECT_EQ(jump, 20);
    m.push(2, middle_of(1) - (1 << 10), 0);
    EXPECT_EQ(m.bench.cycles_until(m.block, m.met), 2 * CellMarch::kStages + 1);
    EXPECT_EQ(m.met.pop().depth_q3, 8 * (102 + 112) / 2);
    m.met.commit();
    // The next column beside the same cells, nearer to the second line: the words are already stored, and take as many
    // cycles.
    column.column = 3;
    column.line_part = 6;
    column.same_cells = true;
    put(m.columns, column);
    m.push(3, middle_of(1) - (1 << 10), 0);
    EXPECT_EQ(m.bench.cycles_until(m.block, m.met), 1 + 8 + 2 * CellMarch::kStages);
    EXPECT_EQ(m.met.front().depth_q3, 8 * (106 + 116) / 2);
}

// Two places in p on two surfaces: the nearer one has more weight, and the farthest cell is behind both. A returned
// pixel repeats the turns of the foot.
TEST(CellMarchTiming, ReturnedPixelsHitTheSurfaceBehindTheLast) {
    MarchBench m;
    ColumnSetup column = column_of(RayKind::shape, 2);
    column.p_part = 3;
    m.put_band_1(column, {{100, 100}, {140, 150}}, true);
    m.push(2, middle_of(1), 0);
    for (const int depth_q3 : {8 * 100, 8 * 140, 8 * 150}) {
        EXPECT_EQ(m.bench.cycles_until(m.block, m.met), 2 * CellMarch::kStages + 1);
        EXPECT_EQ(m.met.front().depth_q3, depth_q3);
        EXPECT_EQ(m.met.front().final, depth_q3 == 8 * 150);
        m.again.push({2, m.met.pop().next});
        m.met.commit();
        m.again.commit();
    }
}

}  // namespace
}  // namespace rs::engine::model
