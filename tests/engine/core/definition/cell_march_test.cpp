// Tests of the surfaces that a ray meets (engine/RECONSTRUCTION.md, section 6). The viewpoint is on the axis at height
// b, so that the foot is at height b, too, and the reference slope is 0 if b is the reference height. The ray passes
// the centre of one column of cells; shape_cells_test.cpp tests rays between columns. If all adjacent cells have a
// surface, the last surface met is the farthest of them.
#include "engine/core/definition/cell_march.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace rs::engine {
namespace {

constexpr std::uint8_t kByBoth = ShapeCell::kByBoth;
constexpr std::int32_t kOne_q20 = 1 << 20;
constexpr std::int32_t kStep_q24 = 1 << 18;  // so per_depth_q20 = slope_q20 * bands per unit / 64

struct Column {
    ShapeMap shape;
    ShapeSetup setup;
    std::vector<ShapeCell> cells;

    // Bands of one radius each; the foot of a ray at height 0 is at the lower end of band bands / 2 and at depth 128.
    // Effective depths are those of a distant reference viewpoint, so that bands are linear in depth.
    Column(int bands, ShapeCell cell) : cells(static_cast<std::size_t>(bands), cell) {
        shape.bands = bands;
        shape.bands_per_unit_q12 = 1 << 12;
        shape.h_low_q20 = -bands / 2 * kOne_q20;
        shape.reference_distance_q20 = std::numeric_limits<std::int32_t>::max();
        shape.depth_low_q20 = -2 * kOne_q20;
        shape.depth_step_q24 = kStep_q24;
        setup.inverse_r_q20 = kOne_q20;
        setup.inverse_rho_q20 = kOne_q20 / 3;
        shape.jump = 20;
        for (auto& lines : setup.cells.at) lines[0] = lines[1] = cells.data();
    }
    Column(const Column&) = delete;
    Column& operator=(const Column&) = delete;

    // Depths of the surfaces met, in eighths of a step.
    [[nodiscard]] std::vector<int> met(std::int32_t slope_q20, std::int32_t b_q20 = 0) const {
        CellMarch march(shape, setup, b_q20, slope_q20 * 16);
        std::vector<int> result;
        for (SurfaceCell cell = march.next(); cell.exists(); cell = march.next()) result.push_back(cell.depth_q3);
        EXPECT_FALSE(march.next().exists());
        return result;
    }
};

TEST(CellMarch, ARayOfReferenceSlopeMeetsTheSurfaceOfItsFootAlone) {
    Column column(8, {});
    for (int band = 0; band < 8; ++band)
        column.cells[static_cast<std::size_t>(band)] = {std::uint8_t(band * 10), kByBoth};
    const auto at = [&](std::int32_t b_q20) {
        column.shape.reference_height_q20 = b_q20;
        return column.met(0, b_q20);
    };
    // On the border of bands 3 and 4, and an eighth of a band below and above it.
    EXPECT_EQ(at(0), (std::vector<int>{35 * 8, 40 * 8}));
    EXPECT_EQ(at(-kOne_q20 / 8), (std::vector<int>{35 * 8 - 10, 40 * 8}));
    EXPECT_EQ(at(kOne_q20 / 8), (std::vector<int>{35 * 8 + 10, 40 * 8}));
    EXPECT_EQ(at(kOne_q20 / 8 - 256), (std::vector<int>{35 * 8, 40 * 8}));
    // The first and the last cell reach one band beyond their centres, as far as their weight is above 0.
    EXPECT_EQ(at(-9 * kOne_q20 / 2 + kOne_q20 / 8), (std::vector<int>{0}));
    EXPECT_TRUE(at(-9 * kOne_q20 / 2 + kOne_q20 / 8 - 256).empty());
    EXPECT_EQ(at(9 * kOne_q20 / 2 - 256), (std::vector<int>{70 * 8}));
    EXPECT_TRUE(at(9 * kOne_q20 / 2).empty());
}

// A ray with the slope of the reference ray through the same foot stays in its band.
TEST(CellMarch, ARayFromTheReferenceViewpointStaysInItsBand) {
    Column column(8, {100, kByBoth});
    column.setup.lambda_foot_q20 = 3 * kOne_q20;
    EXPECT_EQ(column.met(kOne_q20 / 2).size(), 2U);
    column.setup.lambda_foot_q20 = kOne_q20;
    EXPECT_GT(column.met(kOne_q20 / 2).size(), 2U);
}

// Every step meets a surface, so that the number of surfaces is that of the steps plus two at the end.
TEST(CellMarch, CountsItsSteps) {
    Column column(4096, {0, kByBoth});
    column.shape.thickness = 255;
    const auto steps = [&](std::int32_t per_depth_q20) {
        const std::vector<int> met = column.met(per_depth_q20 * 64);
        const int taken = static_cast<int>(met.size()) - 2;
        for (int i = 0; i < taken; ++i) {
            EXPECT_EQ(met[static_cast<std::size_t>(i)], i * met[1]);
        }
        for (std::size_t i = met.size() - 2; i < met.size(); ++i) EXPECT_EQ(met[i], 0);
        return taken;
    };
    for (const int sign : {1, -1}) {
        EXPECT_EQ(steps(0), 0);
        EXPECT_EQ(steps(sign * 2047), 0);  // half a band over the whole depth range
        EXPECT_EQ(steps(sign * 2048), 2);
        EXPECT_EQ(steps(sign * (2 * 2048 - 1)), 2);
        EXPECT_EQ(steps(sign * 2 * 2048), 4);  // three of size 85, and one that begins at 255
        EXPECT_EQ(steps(sign * 3 * 2048), 4);
        EXPECT_EQ(steps(sign * 31 * 2048), 32);
        EXPECT_EQ(steps(sign * 62 * 2048), 64);
        EXPECT_EQ(steps(sign * 63 * 2048), 64);
        EXPECT_EQ(steps(sign * 200 * 2048), 64);
    }
}

TEST(CellMarch, TakesAtMostTheMaximumNumberOfSteps) {
    Column column(4096, {0, kByBoth});
    column.shape.thickness = 255;
    column.shape.bands_per_unit_q12 = 1 << 26;
    column.shape.h_low_q20 = -kOne_q20 / 8;
    for (const std::int32_t slope_q20 : {kOne_q20, -kOne_q20, 127 * kOne_q20, -127 * kOne_q20}) {
        EXPECT_LE(column.met(slope_q20 >> 4).size(), CellMarch::kMaxSteps + 2U);
    }
    // At most 4 bands per depth: from 1024 bands below the foot up to the foot, all inside the map.
    EXPECT_EQ(column.met(7 * kOne_q20).size(), CellMarch::kMaxSteps + 2U);
}

// Half a band per step, from band -4 to band 4 relative to the foot. The map has the upper or the lower half of them;
// its last cell reaches half a band, which is one step, farther.
TEST(CellMarch, LeavesTheBandsAndEntersThem) {
    Column column(8, {0, kByBoth});
    column.shape.thickness = 255;
    const auto begins = [&](std::int32_t slope_q20, std::int32_t h_low_q20) {
        column.shape.h_low_q20 = h_low_q20;
        std::vector<int> depths;
        for (const int depth_q3 : column.met(slope_q20)) depths.push_back(depth_q3 / 8);
        return depths;
    };
    const std::int32_t slope_q20 = 16 * 2048 * 64 - 64;  // sixteen steps of 16
    std::vector<int> all;
    for (int begin = 0; begin < 256; begin += 16) all.push_back(begin);
    std::vector<int> nearer(all.begin(), all.begin() + 9);
    std::vector<int> farther(all.begin() + 7, all.end());
    // The march ends with the surface at depth 0, the depth of the foot's surface. If the ray is inside the map at that
    // depth (`nearer`), the farthest cell follows. If it is outside (`farther`), the surface of the foot is used, at
    // the border of the map.
    nearer.insert(nearer.end(), {0, 0});
    farther.push_back(0);
    // Behind the foot (depth 128) a rising ray is above height 0, a falling one below.
    EXPECT_EQ(begins(-slope_q20, -8 * kOne_q20), farther);
    EXPECT_EQ(begins(slope_q20, -8 * kOne_q20), nearer);
    EXPECT_EQ(begins(slope_q20, 0), farther);
    EXPECT_EQ(begins(-slope_q20, 0), nearer);
    EXPECT_TRUE(begins(slope_q20, 5 * kOne_q20).empty());
    EXPECT_TRUE(begins(slope_q20, -13 * kOne_q20).empty());
}

TEST(CellMarch, MeetsASurfaceOfTheMapsThickness) {
    const std::int32_t four_steps_q20 = 3 * 2048 * 64;
    const auto met = [&](int depth, int thickness) {
        Column column(64, {static_cast<std::uint8_t>(depth), kByBoth});
        column.shape.thickness = thickness;
        std::vector<int> found = column.met(four_steps_q20);
        for (int end = 0; end < 2; ++end) {  // surfaces at the end have the depth of the map
            EXPECT_EQ(found.back(), 8 * depth);
            found.pop_back();
        }
        return found;
    };
    EXPECT_EQ(met(200, 11), (std::vector<int>{8 * 200}));
    EXPECT_EQ(met(193, 2).size(), 1U);
    EXPECT_EQ(met(192, 0).size(), 2U);  // at the border of two steps
    EXPECT_EQ(met(20, 43).size(), 1U);
    EXPECT_EQ(met(20, 44), (std::vector<int>{8 * 20, 8 * 64}));
    EXPECT_EQ(met(255, 255), (std::vector<int>{8 * 255}));
}

// The thickness is measured from the deepest surrounding cell, which may differ from the cells that the ray meets.
TEST(CellMarch, CountsTheThicknessFromTheDeepestCell) {
    const std::int32_t four_steps_q20 = 3 * 2048 * 64;
    Column column(64, {20, kByBoth});
    std::vector<ShapeCell> beside(64, {60, kByBoth});
    for (const ShapeCell*& line : column.setup.cells.at[1]) line = beside.data();
    column.setup.cells.p_part = 1;
    column.shape.thickness = 3;
    EXPECT_EQ(column.met(four_steps_q20), (std::vector<int>{8 * 20, 8 * 20, 8 * 60, 8 * 60}));
    column.shape.thickness = 4;
    EXPECT_EQ(column.met(four_steps_q20), (std::vector<int>{8 * 20, 8 * 64, 8 * 20, 8 * 60, 8 * 60}));
}

// The surface at the foot determines the depth at which a reference ray would meet the object; the march ends with the
// surface of the ray's band at that depth.
TEST(CellMarch, EndsWithTheSurfaceThatAReferenceRayWouldMeet) {
    Column column(8, {});
    column.shape.h_low_q20 -= kOne_q20 / 2;       // the foot is at the centre of band 4
    const std::int32_t one_step_q20 = 2047 * 64;  // an eighth of a band per radius: a quarter down at depth 0
    const auto end = [&](ShapeCell band3, ShapeCell band4) {
        column.cells[3] = band3;
        column.cells[4] = band4;
        return column.met(one_step_q20);
    };
    // At depth 0 the ray is 2/8 below the centre, and band 3 has a quarter of the weight.
    EXPECT_EQ(end({16, kByBoth}, {0, kByBoth}), (std::vector<int>{2 * 16, 8 * 16}));
    // Beyond a jump: the surface with more weight, the one behind it, and the farthest, which is the same here.
    EXPECT_EQ(end({77, kByBoth}, {0, kByBoth}), (std::vector<int>{0, 8 * 77, 8 * 77}));
    EXPECT_EQ(end({0, kByBoth}, {77, kByBoth}), (std::vector<int>{8 * 77, 8 * 77}));
    EXPECT_EQ(end({}, {0, kByBoth}), (std::vector<int>{0}));
    EXPECT_TRUE(end({77, kByBoth}, {}).empty());
    column.setup.cells.p_part = 0;
    column.cells[4] = {};
    EXPECT_TRUE(column.met(one_step_q20).empty());
}

// The foot is an eighth of the way from band 0 to band 1, whose cells have depths 90 and, in the second column along p,
// 255. At depth 90 the ray is lower, where the map is empty.
TEST(CellMarch, EndsWithTheFootsSurfacesWhereNothingLiesAtTheirDepth) {
    Column column(2, {});
    std::vector<ShapeCell> beside(2);
    column.cells[1] = {90, kByBoth};
    beside[1] = {255, kByBoth};
    for (const ShapeCell*& line : column.setup.cells.at[1]) line = beside.data();
    column.setup.cells.p_part = 3;
    column.shape.h_low_q20 = -5 * kOne_q20 / 8;
    EXPECT_EQ(column.met(2047 * 64), (std::vector<int>{8 * 90, 8 * 255}));
}

}  // namespace
}  // namespace rs::engine
