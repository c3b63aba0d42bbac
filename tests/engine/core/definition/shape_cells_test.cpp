// Tests of the surface between cells (engine/RECONSTRUCTION.md, section 6) and of SurfaceColumn, which must equal it on
// every SIMD target.
#include "engine/core/definition/shape_cells.hpp"
#include "engine/core/fast/surface_column.hpp"
#include "tests/support/random.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <vector>

namespace rs::engine {
namespace {

constexpr ShapeCell kNone{};

SurfaceCell between_cells(const SurfaceCell (&cells)[2][2], int p_part, int h_part, int jump) {
    return surfaces_between(cells, p_part, h_part, jump).first;
}

constexpr std::uint8_t kFirst = ShapeCell::kByFirst, kSecond = ShapeCell::kBySecond, kBoth = ShapeCell::kByBoth;

TEST(BetweenLines, InterpolatesInEighthsUpToTheJump) {
    for (int part = 0; part < 8; ++part) {
        EXPECT_EQ(between_lines({100, kBoth}, {120, kBoth}, part, 20),
                  (SurfaceCell{800 + 20 * part, kBothShow, 120, true}));
        EXPECT_EQ(between_lines({120, kBoth}, {100, kBoth}, part, 20),
                  (SurfaceCell{960 - 20 * part, kBothShow, 120, true}));
    }
}

TEST(BetweenLines, TakesTheNearerLineAcrossAJump) {
    for (int part = 0; part < 8; ++part) {
        const SurfaceCell expected{part < 4 ? 800 : 968, kBothShow, 121, true};
        EXPECT_EQ(between_lines({100, kBoth}, {121, kBoth}, part, 20), expected) << part;
    }
}

TEST(BetweenLines, UsesTheOnlyLineWithASurfaceIfItHasWeight) {
    EXPECT_EQ(between_lines({100, kBoth}, kNone, 7, 20), (SurfaceCell{800, kBothShow, 100, false}));
    EXPECT_EQ(between_lines(kNone, {100, kBoth}, 1, 20), (SurfaceCell{800, kBothShow, 100, false}));
    EXPECT_EQ(between_lines(kNone, {100, kBoth}, 0, 20), (SurfaceCell{-1, kBothShow, 100, false}));
    EXPECT_EQ(between_lines(kNone, kNone, 4, 20), SurfaceCell{});
    EXPECT_EQ(between_lines({0, kBoth}, kNone, 4, 20),
              (SurfaceCell{0, kBothShow, 0, false}));  // depth 0 is a surface, too
}

TEST(BetweenLines, InterpolatesTheLeanOfItsCells) {
    constexpr ShapeCell kOfFirst{100, kFirst}, kOfSecond{100, kSecond}, kOfBoth{100, kBoth}, kFar{200, kFirst};
    for (int part = 0; part < 8; ++part) {
        EXPECT_EQ(between_lines(kOfFirst, kOfSecond, part, 20).lean, 2 * part);
        EXPECT_EQ(between_lines(kOfBoth, kOfFirst, part, 20).lean, 8 - part);
        EXPECT_EQ(between_lines(kOfBoth, kOfSecond, part, 20).lean, 8 + part);
        EXPECT_EQ(between_lines(kOfSecond, kFar, part, 20).lean, part < 4 ? 16 : 0);
        EXPECT_EQ(between_lines(kOfSecond, kNone, part, 20).lean, 16);
    }
    EXPECT_EQ(between_lines(kNone, kOfSecond, 5, 20).lean, 16);
}

TEST(BetweenCells, InterpolatesTheLeanOfItsGroup) {
    const SurfaceCell one[2][2] = {{{80, 0}, {80, 8}}, {{80, 16}, {80, 8}}};
    const SurfaceCell two[2][2] = {{{80, 0}, {80, 8}}, {{400, 16}, {400, 12}}};
    for (int p = 0; p < 8; ++p) {
        for (int h = 0; h < 8; ++h) {
            const int sum = 8 * (8 - p) * h + 16 * p * (8 - h) + 8 * p * h;
            EXPECT_EQ(between_cells(one, p, h, 20).lean, (sum + 32) / 64) << p << " " << h;
            const SurfaceStack stack = surfaces_between(two, p, h, 20);
            const int of_near = (8 * h + 4) / 8;
            const int of_far = (16 * (8 - h) + 12 * h + 4) / 8;
            EXPECT_EQ(stack.first.lean, p <= 4 ? of_near : of_far) << p << " " << h;
            EXPECT_EQ(stack.behind.lean, stack.behind.exists() ? of_far : kBothShow) << p << " " << h;
        }
    }
}

TEST(BetweenCells, IsBilinearOnOneSurface) {
    const SurfaceCell cells[2][2] = {{{80}, {160}}, {{240}, {240}}};
    for (int p = 0; p < 8; ++p) {
        for (int h = 0; h < 8; ++h) {
            const int sum = 80 * (8 - p) * (8 - h) + 160 * (8 - p) * h + 240 * p * 8;
            EXPECT_EQ(between_cells(cells, p, h, 20).depth_q3, (sum + 32) / 64) << p << " " << h;
        }
    }
}

TEST(BetweenCells, SelectsTheGroupOfGreaterWeight) {
    const SurfaceCell cells[2][2] = {{{80}, {80}}, {{248}, {248}}};  // 21 depths apart
    for (int p = 0; p < 8; ++p) {
        EXPECT_EQ(between_cells(cells, p, 3, 20).depth_q3, p <= 4 ? 80 : 248) << p;
        EXPECT_EQ(between_cells(cells, p, 3, 21).depth_q3, 80 + 21 * p) << p;
    }
    // Depths up to the mean of near and far, 164, belong to the nearer group.
    const SurfaceCell three[2][2] = {{{80}, {164}}, {{248}, {}}};
    EXPECT_EQ(between_cells(three, 3, 4, 20).depth_q3, (80 * 20 + 164 * 20 + 20) / 40);
    const SurfaceCell other[2][2] = {{{80}, {165}}, {{248}, {}}};
    EXPECT_EQ(between_cells(other, 3, 4, 20).depth_q3, (165 * 20 + 248 * 12 + 16) / 32);
}

TEST(BetweenCells, BehindTheNearerGroupIsTheFartherOne) {
    const SurfaceCell cells[2][2] = {{{80}, {88}}, {{248}, {256}}};  // 22 depths apart at most
    for (int p = 1; p < 8; ++p) {
        EXPECT_EQ(surfaces_between(cells, p, 4, 20).behind.depth_q3, p <= 4 ? 252 : -1) << p;
        EXPECT_FALSE(surfaces_between(cells, p, 4, 22).behind.exists()) << p;  // a single surface
    }
    EXPECT_FALSE(surfaces_between(cells, 0, 4, 20).behind.exists());  // weight 0
    const SurfaceCell nothing[2][2] = {};
    EXPECT_FALSE(surfaces_between(nothing, 3, 4, 20).behind.exists());
}

TEST(BetweenCells, TheFarthestIncludesCellsOfWeightZero) {
    const SurfaceCell cells[2][2] = {{{80, 3, 11, true}, {88, 3, 12, true}}, {{248, 3, 31, true}, {256, 3, 32, true}}};
    for (int p = 0; p < 8; ++p) {
        for (const int jump : {20, 22}) {
            const SurfaceStack stack = surfaces_between(cells, p, 0, jump);
            EXPECT_EQ(stack.farthest, (SurfaceCell{.depth_q3 = 256}));
            EXPECT_EQ(stack.first.deepest, 32);
        }
    }
    SurfaceCell at_depth_0[2][2];
    for (auto& column : at_depth_0) column[0] = column[1] = {0, kBothShow, 0, true};
    EXPECT_EQ(surfaces_between(at_depth_0, 3, 4, 20).farthest, (SurfaceCell{.depth_q3 = 0}));
    for (int n = 0; n < 4; ++n) {
        SurfaceCell lacks_one[2][2] = {{cells[0][0], cells[0][1]}, {cells[1][0], cells[1][1]}};
        lacks_one[n / 2][n % 2].all_have_one = false;
        EXPECT_FALSE(surfaces_between(lacks_one, 3, 4, 20).farthest.exists()) << n;
        EXPECT_EQ(surfaces_between(lacks_one, 3, 4, 20).first.deepest, 32) << n;
    }
}

TEST(BetweenCells, IsEmptyIfNoCellWithASurfaceHasWeight) {
    SurfaceCell cells[2][2] = {};
    cells[1][1] = {80};
    EXPECT_FALSE(between_cells(cells, 0, 5, 20).exists());
    EXPECT_FALSE(between_cells(cells, 5, 0, 20).exists());
    EXPECT_EQ(between_cells(cells, 1, 1, 20), SurfaceCell{80});
}

// A cell of weight 0 can separate the cells into two groups, and can be the deepest.
TEST(BetweenCells, IncludesCellsOfWeightZero) {
    const SurfaceCell cells[2][2] = {{{80, 8, 10}, {160, 8, 20}}, {{400, 8, 50}, {-1, 8, 90}}};
    EXPECT_EQ(between_cells(cells, 0, 4, 20), (SurfaceCell{120, kBothShow, 90}));
}

// --- SurfaceColumn --------------------------------------------------------------------------------------------------

struct Columns {
    std::vector<ShapeCell> cells[2][2];  // [p][line]
    CellColumns around;
    ShapeMap shape;  // only bands, jump and thickness are set
};

Columns random_columns(test::Random& random) {
    Columns columns;
    const int bands = columns.shape.bands = random.whole(1, 100);
    columns.shape.jump = random.whole(1, 60);
    columns.shape.thickness = random.whole(0, 1) == 0 ? 8 : random.whole(0, 255);
    columns.around.p_part = random.whole(0, 7);
    columns.around.line_part = random.whole(0, 7);
    const int roughness = random.whole(0, 2) == 0 ? 100 : random.whole(0, 12);
    const double empty = random.whole(0, 1) == 0 ? 0 : random.real(0, 1);
    const int low = random.whole(0, bands);  // bands outside of low .. high - 1 are empty
    const int high = random.whole(low, bands);
    const int middle = random.whole(0, 255);
    const bool leans = random.whole(0, 1) == 0;
    for (int p = 0; p < 2; ++p) {
        for (int line = 0; line < 2; ++line) {
            std::vector<ShapeCell>& cells = columns.cells[p][line];
            cells.resize(static_cast<std::size_t>(bands));
            for (int band = low; band < high; ++band) {
                if (random.real(0, 1) < empty) continue;
                const int depth = std::clamp(middle + random.whole(-roughness, roughness), 0, 255);
                const int shown = leans ? random.whole(1, 3) : 3;
                cells[static_cast<std::size_t>(band)] = {static_cast<std::uint8_t>(depth),
                                                         static_cast<std::uint8_t>(shown)};
            }
            columns.around.at[p][line] = cells.data();
        }
    }
    return columns;
}

SurfaceStack defined(const Columns& columns, int band, int h_part) {
    SurfaceCell around[2][2];
    for (int p = 0; p < 2; ++p) {
        for (int h = 0; h < 2; ++h) {
            if (band + h < 0 || band + h >= columns.shape.bands) continue;
            const auto at = static_cast<std::size_t>(band + h);
            around[p][h] = between_lines(columns.cells[p][0][at], columns.cells[p][1][at], columns.around.line_part,
                                         columns.shape.jump);
        }
    }
    return surfaces_between(around, columns.around.p_part, h_part, columns.shape.jump);
}

std::int32_t in_16_bits(const SurfaceCell& cell) {
    return cell.exists() ? cell.depth_q3 | cell.lean << kDepthBits : kNoSurface;
}

// Depth of an entry without kSurfaceSteps.
int smooth_depth_q3(std::int32_t entry, int h_part) {
    return (8 * (entry & ((1 << kLowBits) - 1)) + h_part * (entry >> 16) + 32) >> 6;
}

void expect_column(const Columns& columns) {
    constexpr std::size_t kStart = 5;
    const std::size_t most = surface_entries(columns.shape.bands);
    SurfaceEntries entries;
    entries.grow(kStart + most + 1);
    constexpr std::int32_t kUntouched = -12345;
    for (auto* const numbers : {&entries.smooth, &entries.deepest, &entries.steps}) {
        std::fill(numbers->begin(), numbers->end(), kUntouched);
    }
    const SurfaceColumn column = build_surface_column(columns.around, columns.shape, kStart, entries);
    for (const auto* const numbers : {&entries.smooth, &entries.deepest}) {
        EXPECT_EQ((*numbers)[kStart - 1], kUntouched);
        EXPECT_EQ((*numbers)[kStart + most], kUntouched);
    }
    EXPECT_EQ(entries.steps[kSurfaceParts * kStart - 1], kUntouched);
    EXPECT_EQ(entries.steps[kSurfaceParts * (kStart + most)], kUntouched);
    EXPECT_EQ(entries.smooth[kStart], kSurfaceNothing);
    EXPECT_EQ(entries.smooth[kStart + static_cast<std::size_t>(column.last)], kSurfaceNothing);
    int nearest = 256 * 8;
    int beyond = 0;
    for (int band = -1; band < columns.shape.bands; ++band) {
        for (int h_part = 0; h_part < 8; ++h_part) {
            const auto [expected, behind, farthest] = defined(columns, band, h_part);
            const int n = std::clamp(band - column.first_band, 0, column.last);
            const std::size_t at = kStart + static_cast<std::size_t>(n);
            const std::int32_t smooth = entries.smooth[at];
            if ((smooth & kSurfaceNothing) != 0) {
                ASSERT_FALSE(expected.exists()) << band << " " << h_part;
                continue;
            }
            ASSERT_EQ(entries.deepest[at] >> 16, farthest.exists() ? 0 : -1) << band << " " << h_part;
            const std::int32_t deepest = entries.deepest[at] & 0xFFFF;
            if (farthest.exists()) {
                ASSERT_EQ(8 * deepest, farthest.depth_q3) << band << " " << h_part;
            }
            if (expected.exists()) {
                ASSERT_EQ(deepest, expected.deepest) << band << " " << h_part;
                nearest = std::min(nearest, expected.depth_q3);
                beyond = std::max(beyond, std::min(expected.deepest + columns.shape.thickness + 1, 256));
            }
            if ((smooth & kSurfaceSteps) == 0) {
                ASSERT_EQ(smooth_depth_q3(smooth, h_part), expected.depth_q3) << band << " " << h_part;
                ASSERT_EQ(expected.lean, kBothShow) << band << " " << h_part;
                continue;
            }
            const int index = 8 * (smooth & ((1 << kLowBits) - 1)) + h_part * (smooth >> 16);
            const std::int32_t both = entries.steps[kSurfaceParts * kStart + static_cast<std::size_t>(index)];
            ASSERT_EQ(both & 0xFFFF, in_16_bits(expected)) << band << " " << h_part;
            ASSERT_EQ(both >> 16 & 0xFFFF, in_16_bits(behind)) << band << " " << h_part;
        }
    }
    EXPECT_LE(column.nearest, nearest / 8);
    EXPECT_GE(column.beyond, beyond);
    EXPECT_LE(column.beyond, 256);
}

TEST(SurfaceColumn, EqualsTheDefinitionOnEverySimdTarget) {
    std::int64_t targets = hwy::SupportedTargets();
    while (targets != 0) {
        const std::int64_t target = targets & -targets;
        targets &= targets - 1;
        SCOPED_TRACE(hwy::TargetName(target));
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        for (std::uint64_t seed = 0; seed < 400; ++seed) {
            SCOPED_TRACE(seed);
            test::Random random(seed);
            expect_column(random_columns(random));
            if (testing::Test::HasFatalFailure()) break;
        }
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(SurfaceColumn, OfARayWithoutAShapeIsEmpty) {
    SurfaceEntries entries;
    entries.grow(1);
    const SurfaceColumn column = build_empty_column(0, entries);
    EXPECT_EQ(column.last, 0);
    EXPECT_EQ(entries.smooth[0], kSurfaceNothing);
    EXPECT_EQ(column.nearest, 256);
    EXPECT_EQ(column.beyond, 0);
}

}  // namespace
}  // namespace rs::engine
