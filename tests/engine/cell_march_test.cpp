// Which cells a ray meets (engine/RECONSTRUCTION.md, section 6), on rays made by hand: the viewpoint stands over the
// axis at height b, so that the foot is at height b too and the reference slope is 0 where b is the reference height.
#include "engine/core/cell_march.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rs::engine {
namespace {

constexpr std::int32_t kOne_q20 = 1 << 20;
constexpr std::int32_t kStep_q24 = 1 << 18;  // so per_depth_q20 = slope_q20 * bands per unit / 64
constexpr std::uint8_t kBoth = kFirstSeesLayer0 | kSecondSeesLayer0;

struct Column {
    ShapeMap shape;
    ShapeSetup setup;
    std::vector<ShapeCell> cells;

    // Bands of one radius each; the foot of a ray at height 0 stands at the lower end of band bands / 2. Depth 128 is
    // the foot's.
    Column(int bands, ShapeCell cell) : cells(static_cast<std::size_t>(bands), cell) {
        shape.bands = bands;
        shape.bands_per_unit_q12 = 1 << 12;
        shape.h_low_q20 = -bands / 2 * kOne_q20;
        shape.reference_distance_q20 = 3 * kOne_q20;
        shape.depth_low_q20 = -2 * kOne_q20;
        shape.depth_step_q24 = kStep_q24;
        setup.inverse_r_q20 = kOne_q20;
        setup.inverse_rho_q20 = kOne_q20 / 3;
        setup.cells = cells.data();
    }
    Column(const Column&) = delete;
    Column& operator=(const Column&) = delete;

    [[nodiscard]] std::vector<ShapeCell> met(std::int32_t slope_q20, std::int32_t b_q20 = 0) const {
        CellMarch march(shape, setup, b_q20, slope_q20 * 16);
        std::vector<ShapeCell> result;
        for (ShapeCell cell = march.next(); cell.rays != 0; cell = march.next()) result.push_back(cell);
        EXPECT_EQ(march.next().rays, 0);
        return result;
    }
};

TEST(CellMarch, ARayOfReferenceSlopeMeetsTheCellOfItsFootAlone) {
    Column column(8, {});
    for (int band = 0; band < 8; ++band)
        column.cells[static_cast<std::size_t>(band)] = {{std::uint8_t(band * 10), 0}, 255, kBoth};
    const auto at = [&](std::int32_t b_q20) {
        column.shape.reference_height_q20 = b_q20;
        return column.met(0, b_q20);
    };
    EXPECT_EQ(at(0), (std::vector<ShapeCell>{{{40, 0}, 255, kBoth}}));
    // The first and the last band, each on both sides of its outer border; heights are q16.
    EXPECT_EQ(at(-4 * kOne_q20), (std::vector<ShapeCell>{{{0, 0}, 255, kBoth}}));
    EXPECT_TRUE(at(-4 * kOne_q20 - 16).empty());
    EXPECT_EQ(at(4 * kOne_q20 - 16 * 16), (std::vector<ShapeCell>{{{70, 0}, 255, kBoth}}));
    EXPECT_TRUE(at(4 * kOne_q20).empty());
}

// A ray that rises as the one from the reference viewpoint through the same foot stays in its band.
TEST(CellMarch, TheReferenceViewpointSeesEveryBandAlongItself) {
    Column column(8, {{100, 0}, 110, kBoth});
    column.setup.lambda_foot_q20 = 3 * kOne_q20;
    EXPECT_EQ(column.met(kOne_q20 / 2).size(), 1U);
    column.setup.lambda_foot_q20 = kOne_q20;
    EXPECT_GT(column.met(kOne_q20 / 2).size(), 1U);
}

// Cells that are met wherever they are looked at: their number is that of the steps, and one at the end.
TEST(CellMarch, CountsItsSteps) {
    const Column column(4096, {{0, 0}, 255, kBoth});
    const auto steps = [&](std::int32_t per_depth_q20) {
        const std::vector<ShapeCell> met = column.met(per_depth_q20 * 64);
        if (met.size() < 2) return static_cast<int>(met.size()) - 1;
        const int size = met[1].depth[0];
        for (std::size_t i = 0; i + 1 < met.size(); ++i) EXPECT_EQ(met[i].depth[0], static_cast<int>(i) * size);
        EXPECT_EQ(met.back().depth[0], 0);
        return static_cast<int>(met.size()) - 1;
    };
    for (const int sign : {1, -1}) {
        EXPECT_EQ(steps(0), 0);
        EXPECT_EQ(steps(sign * 2047), 0);  // half a band over all depths
        EXPECT_EQ(steps(sign * 2048), 2);
        EXPECT_EQ(steps(sign * (2 * 2048 - 1)), 2);
        EXPECT_EQ(steps(sign * 2 * 2048), 4);  // three of 85, and one that begins at 255
        EXPECT_EQ(steps(sign * 3 * 2048), 4);
        EXPECT_EQ(steps(sign * 31 * 2048), 32);
        EXPECT_EQ(steps(sign * 62 * 2048), 64);
        EXPECT_EQ(steps(sign * 63 * 2048), 64);
        EXPECT_EQ(steps(sign * 200 * 2048), 64);
    }
}

TEST(CellMarch, NeverTakesMoreThanItsMostSteps) {
    Column column(4096, {{0, 0}, 255, kBoth});
    column.shape.bands_per_unit_q12 = 1 << 26;
    column.shape.h_low_q20 = -kOne_q20 / 8;
    for (const std::int32_t slope_q20 : {kOne_q20, -kOne_q20, 127 * kOne_q20, -127 * kOne_q20}) {
        EXPECT_LE(column.met(slope_q20 >> 4).size(), CellMarch::kMostSteps + 1U);
    }
    // 4 bands per depth at most: from 1024 bands below the foot up to it, all of them in the map.
    EXPECT_EQ(column.met(7 * kOne_q20).size(), CellMarch::kMostSteps + 1U);
}

// Half a band per step, bands -4 .. 4 of the foot, of which the map has the upper or lower half.
TEST(CellMarch, LeavesTheBandsAndEntersThem) {
    Column column(8, {{0, 0}, 255, kBoth});
    const auto begins = [&](std::int32_t slope_q20, std::int32_t h_low_q20) {
        column.shape.h_low_q20 = h_low_q20;
        std::vector<int> depths;
        for (const ShapeCell& cell : column.met(slope_q20)) depths.push_back(cell.depth[0]);
        return depths;
    };
    const std::int32_t slope_q20 = 16 * 2048 * 64 - 64;  // sixteen steps of 16
    std::vector<int> all;
    for (int begin = 0; begin < 256; begin += 16) all.push_back(begin);
    const std::vector<int> nearer(all.begin(), all.begin() + 8);
    const std::vector<int> farther(all.begin() + 8, all.end());
    // Behind the foot (depth 128) the rising ray is above 0, a sinking one below.
    EXPECT_EQ(begins(-slope_q20, -8 * kOne_q20), farther);
    EXPECT_EQ(begins(slope_q20, -8 * kOne_q20), nearer);
    auto with_foot = farther;
    with_foot.push_back(0);  // the foot itself is in band 0
    EXPECT_EQ(begins(slope_q20, 0), with_foot);
    with_foot = nearer;
    with_foot.push_back(0);
    EXPECT_EQ(begins(-slope_q20, 0), with_foot);
    EXPECT_TRUE(begins(slope_q20, 5 * kOne_q20).empty());
    EXPECT_TRUE(begins(slope_q20, -13 * kOne_q20).empty());
}

TEST(CellMarch, MeetsACellBetweenItsNearestLayerAndItsBack) {
    const std::int32_t four_steps_q20 = 3 * 2048 * 64;
    const auto met = [&](ShapeCell cell) {
        auto found = Column(64, cell).met(four_steps_q20);
        EXPECT_EQ(found.back(), cell);  // the one at the end is as the map has it
        found.pop_back();
        return found;
    };
    const auto one = [&](int depth, int back) {
        return met({{static_cast<std::uint8_t>(depth), 0}, static_cast<std::uint8_t>(back), kBoth});
    };
    EXPECT_EQ(one(200, 210), (std::vector<ShapeCell>{{{200, 192}, 210, kBoth}}));
    EXPECT_EQ(one(193, 193).size(), 1U);
    EXPECT_EQ(one(192, 192).size(), 2U);  // on the border of two steps
    EXPECT_EQ(one(20, 63).size(), 1U);
    EXPECT_EQ(one(20, 64), (std::vector<ShapeCell>{{{20, 0}, 64, kBoth}, {{64, 64}, 64, kBoth}}));
    // Layer 1 is nearer, and counts only where it exists.
    const std::uint8_t all = kBoth | kFirstSeesLayer1;
    EXPECT_EQ(met({{200, 100}, 210, all}),
              (std::vector<ShapeCell>{{{200, 100}, 210, all}, {{200, 128}, 210, all}, {{200, 192}, 210, all}}));
    EXPECT_EQ(met({{200, 100}, 210, kBoth}).size(), 1U);
}

// At the end: the foot's cell says at what depth a reference ray would meet the object; the cell of that place answers.
TEST(CellMarch, EndsWithTheCellThatAReferenceRayWouldMeet) {
    Column column(8, {});
    const std::int32_t one_step_q20 = 2047 * 64;  // an eighth of a band per radius and 4 radii: half a band
    column.cells[4] = {{0, 0}, 0, kBoth};         // where nothing is met on the way
    column.cells[3] = {{77, 0}, 77, kBoth};
    EXPECT_EQ(column.met(one_step_q20), (std::vector<ShapeCell>{column.cells[3]}));
    column.cells[3] = {};
    EXPECT_EQ(column.met(one_step_q20), (std::vector<ShapeCell>{column.cells[4]}));
    column.cells[4] = {};
    column.cells[3] = {{77, 0}, 77, kBoth};
    EXPECT_TRUE(column.met(one_step_q20).empty());
}

}  // namespace
}  // namespace rs::engine
