// The surface between cells (engine/RECONSTRUCTION.md, section 6), and its preparation for a whole column, which must
// say the same on every SIMD target.
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

// Backs whose lowest bits are 3: both pictures show the surface.
TEST(BetweenLines, InterpolatesInEighthsUpToTheJump) {
    for (int part = 0; part < 8; ++part) {
        EXPECT_EQ(between_lines({100, 111}, {120, 115}, part, 20),
                  (SurfaceCell{800 + 20 * part, part > 0 ? 115 : 111, kBothShow, 120}));
        EXPECT_EQ(between_lines({120, 131}, {100, 127}, part, 20), (SurfaceCell{960 - 20 * part, 131, kBothShow, 120}));
    }
}

TEST(BetweenLines, TakesTheNearerLineAcrossAJump) {
    for (int part = 1; part < 8; ++part) {
        const SurfaceCell expected{part < 4 ? 800 : 968, 123, kBothShow, 121};
        EXPECT_EQ(between_lines({100, 111}, {121, 123}, part, 20), expected) << part;
    }
    EXPECT_EQ(between_lines({100, 111}, {121, 123}, 0, 20), (SurfaceCell{800, 111, kBothShow, 121}));
}

TEST(BetweenLines, OneAloneAnswersAndTheSecondOnlyWhereItHasWeight) {
    EXPECT_EQ(between_lines({100, 111}, kNone, 7, 20), (SurfaceCell{800, 111}));
    EXPECT_EQ(between_lines(kNone, {100, 111}, 1, 20), (SurfaceCell{800, 111}));
    EXPECT_FALSE(between_lines(kNone, {100, 111}, 0, 20).exists());
    EXPECT_FALSE(between_lines(kNone, kNone, 4, 20).exists());
    EXPECT_EQ(between_lines({0, 4}, kNone, 4, 20), (SurfaceCell{0, 4}));  // depth 0 is a surface, too
}

// Lowest bits 1: the first picture alone shows it; 2: the second; 0 and 3: both.
TEST(BetweenLines, LeansAsItsCellsDo) {
    constexpr ShapeCell kFirst{100, 113}, kSecond{100, 114}, kBoth{100, 115}, kUnsaid{100, 112}, kFar{200, 201};
    for (int part = 0; part < 8; ++part) {
        EXPECT_EQ(between_lines(kFirst, kSecond, part, 20).lean, 2 * part);
        EXPECT_EQ(between_lines(kBoth, kFirst, part, 20).lean, 8 - part);
        EXPECT_EQ(between_lines(kUnsaid, kSecond, part, 20).lean, 8 + part);
        EXPECT_EQ(between_lines(kSecond, kFar, part, 20).lean, part < 4 ? 16 : 0);
        EXPECT_EQ(between_lines(kSecond, kNone, part, 20).lean, 16);
    }
    EXPECT_EQ(between_lines(kNone, kSecond, 5, 20).lean, 16);
}

TEST(BetweenCells, LeansAsTheCellsOfItsGroupDo) {
    const SurfaceCell one[2][2] = {{{80, 20, 0}, {80, 20, 8}}, {{80, 20, 16}, {80, 20, 8}}};
    const SurfaceCell two[2][2] = {{{80, 20, 0}, {80, 20, 8}}, {{400, 40, 16}, {400, 40, 12}}};
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
    const SurfaceCell cells[2][2] = {{{80, 20}, {160, 30}}, {{240, 25}, {240, 10}}};
    for (int p = 0; p < 8; ++p) {
        for (int h = 0; h < 8; ++h) {
            const int sum = 80 * (8 - p) * (8 - h) + 160 * (8 - p) * h + 240 * p * 8;
            EXPECT_EQ(between_cells(cells, p, h, 20), (SurfaceCell{(sum + 32) / 64, 30})) << p << " " << h;
        }
    }
}

TEST(BetweenCells, StepsWhereTheGreaterWeightSays) {
    const SurfaceCell cells[2][2] = {{{80, 20}, {80, 20}}, {{248, 40}, {248, 40}}};  // 21 depths apart
    for (int p = 0; p < 8; ++p) {
        EXPECT_EQ(between_cells(cells, p, 3, 20), (SurfaceCell{p <= 4 ? 80 : 248, 40})) << p;
        EXPECT_EQ(between_cells(cells, p, 3, 21).depth_q3, 80 + 21 * p) << p;
    }
    // What lies between near and far belongs to the nearer half: 164 is in their middle, 165 is not.
    const SurfaceCell three[2][2] = {{{80, 20}, {164, 30}}, {{248, 40}, {}}};
    EXPECT_EQ(between_cells(three, 3, 4, 20).depth_q3, (80 * 20 + 164 * 20 + 20) / 40);
    const SurfaceCell other[2][2] = {{{80, 20}, {165, 30}}, {{248, 40}, {}}};
    EXPECT_EQ(between_cells(other, 3, 4, 20).depth_q3, (165 * 20 + 248 * 12 + 16) / 32);
}

TEST(BetweenCells, BehindTheNearerGroupIsTheFartherOne) {
    const SurfaceCell cells[2][2] = {{{80, 20}, {88, 20}}, {{248, 40}, {256, 40}}};  // 22 depths apart at most
    for (int p = 1; p < 8; ++p) {
        EXPECT_EQ(surfaces_between(cells, p, 4, 20).behind, (p <= 4 ? SurfaceCell{252, 40} : SurfaceCell{})) << p;
        EXPECT_FALSE(surfaces_between(cells, p, 4, 22).behind.exists()) << p;  // one surface
    }
    EXPECT_FALSE(surfaces_between(cells, 0, 4, 20).behind.exists());  // without weight
    const SurfaceCell nothing[2][2] = {};
    EXPECT_FALSE(surfaces_between(nothing, 3, 4, 20).behind.exists());
}

TEST(BetweenCells, TheFarthestIsOneOfAllCellsWhateverTheirWeights) {
    const SurfaceCell cells[2][2] = {{{80, 20, 3, 11}, {88, 20, 3, 12}}, {{248, 40, 3, 31}, {256, 41, 3, 32}}};
    for (int p = 0; p < 8; ++p) {
        for (const int jump : {20, 22}) EXPECT_EQ(surfaces_between(cells, p, 0, jump).farthest, (SurfaceCell{256, 41}));
    }
    SurfaceCell at_depth_0[2][2];
    for (auto& column : at_depth_0) column[0] = column[1] = {0, 1, kBothShow, 0};
    EXPECT_EQ(surfaces_between(at_depth_0, 3, 4, 20).farthest, (SurfaceCell{0, 1}));
    for (int n = 0; n < 4; ++n) {
        SurfaceCell lacks_one[2][2] = {{cells[0][0], cells[0][1]}, {cells[1][0], cells[1][1]}};
        lacks_one[n / 2][n % 2].farthest = -1;
        EXPECT_FALSE(surfaces_between(lacks_one, 3, 4, 20).farthest.exists()) << n;
    }
}

TEST(BetweenCells, IsNothingWhereAllWeightIsOnNothing) {
    SurfaceCell cells[2][2] = {};
    cells[1][1] = {80, 20};
    EXPECT_FALSE(between_cells(cells, 0, 5, 20).exists());
    EXPECT_FALSE(between_cells(cells, 5, 0, 20).exists());
    EXPECT_EQ(between_cells(cells, 1, 1, 20), (SurfaceCell{80, 20}));
}

// Of weight 0 but there: it makes a step of what would be one surface, and its back counts.
TEST(BetweenCells, HeedsCellsWithoutWeight) {
    const SurfaceCell cells[2][2] = {{{80, 20}, {160, 30}}, {{400, 90}, {400, 90}}};
    EXPECT_EQ(between_cells(cells, 0, 4, 20), (SurfaceCell{120, 90}));
}

// ---------------------------------------------------------------------------------------------------------------------

struct Columns {
    std::vector<ShapeCell> cells[2][2];  // [p][line]
    CellColumns around;
    int bands = 0;
    int jump = 0;
};

Columns random_columns(test::Random& random) {
    Columns columns;
    columns.bands = random.whole(1, 100);
    columns.jump = random.whole(1, 60);
    columns.around.p_part = random.whole(0, 7);
    columns.around.line_part = random.whole(0, 7);
    const int roughness = random.whole(0, 2) == 0 ? 100 : random.whole(0, 12);
    const double empty = random.whole(0, 1) == 0 ? 0 : random.real(0, 1);
    const int low = random.whole(0, columns.bands);  // nothing below, nor from `high` on
    const int high = random.whole(low, columns.bands);
    const int middle = random.whole(0, 255);
    const bool leans = random.whole(0, 1) == 0;
    for (int p = 0; p < 2; ++p) {
        for (int line = 0; line < 2; ++line) {
            std::vector<ShapeCell>& cells = columns.cells[p][line];
            cells.resize(static_cast<std::size_t>(columns.bands));
            for (int band = low; band < high; ++band) {
                if (random.real(0, 1) < empty) continue;
                const int depth = std::clamp(middle + random.whole(-roughness, roughness), 0, 255);
                const int both = leans && random.whole(0, 1) == 0 ? 0 : ShapeCell::kByBoth;
                const int back = std::clamp(depth + random.whole(0, 90), 1, 255) | both;
                cells[static_cast<std::size_t>(band)] = {static_cast<std::uint8_t>(depth),
                                                         static_cast<std::uint8_t>(back)};
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
            if (band + h < 0 || band + h >= columns.bands) continue;
            const auto at = static_cast<std::size_t>(band + h);
            around[p][h] =
                between_lines(columns.cells[p][0][at], columns.cells[p][1][at], columns.around.line_part, columns.jump);
        }
    }
    return surfaces_between(around, columns.around.p_part, h_part, columns.jump);
}

std::int32_t in_16_bits(const SurfaceCell& cell) {
    return cell.exists() ? cell.depth_q3 | cell.lean << kDepthBits : kNoSurface;
}

// What an entry says where it does not send its reader to `steps`.
int smooth_depth_q3(std::int32_t entry, int h_part) {
    return (8 * (entry & ((1 << kLowBits) - 1)) + h_part * (entry >> 16) + 32) >> 6;
}

void expect_column(const Columns& columns) {
    constexpr std::size_t kStart = 5;
    const std::size_t most = surface_entries(columns.bands);
    SurfaceEntries entries;
    entries.hold(kStart + most + 1);
    constexpr std::int32_t kUntouched = -12345;
    for (auto* const numbers : {&entries.smooth, &entries.backs, &entries.steps}) {
        std::fill(numbers->begin(), numbers->end(), kUntouched);
    }
    const SurfaceColumn column = lay_surfaces(columns.around, columns.bands, columns.jump, kStart, entries);
    for (const auto* const numbers : {&entries.smooth, &entries.backs}) {
        EXPECT_EQ((*numbers)[kStart - 1], kUntouched);
        EXPECT_EQ((*numbers)[kStart + most], kUntouched);
    }
    EXPECT_EQ(entries.steps[kSurfaceParts * kStart - 1], kUntouched);
    EXPECT_EQ(entries.steps[kSurfaceParts * (kStart + most)], kUntouched);
    EXPECT_EQ(entries.smooth[kStart], kSurfaceNothing);
    EXPECT_EQ(entries.smooth[kStart + static_cast<std::size_t>(column.last)], kSurfaceNothing);
    int nearest = 256 * 8;
    int beyond = 0;
    for (int band = -1; band < columns.bands; ++band) {
        for (int h_part = 0; h_part < 8; ++h_part) {
            const auto [expected, behind, farthest] = defined(columns, band, h_part);
            const int n = std::clamp(band - column.first_band, 0, column.last);
            const std::size_t at = kStart + static_cast<std::size_t>(n);
            const std::int32_t smooth = entries.smooth[at];
            if ((smooth & kSurfaceNothing) != 0) {
                ASSERT_FALSE(expected.exists()) << band << " " << h_part;
                continue;
            }
            ASSERT_EQ(entries.backs[at] >> 16, farthest.exists() ? farthest.depth_q3 : -1) << band << " " << h_part;
            const std::int32_t back = entries.backs[at] & 0xFFFF;
            if (expected.exists()) {
                ASSERT_EQ(back, expected.back) << band << " " << h_part;
                nearest = std::min(nearest, expected.depth_q3);
                beyond = std::max(beyond, expected.back + 1);
            }
            if ((smooth & kSurfaceSteps) == 0) {
                ASSERT_EQ(smooth_depth_q3(smooth, h_part), expected.depth_q3) << band << " " << h_part;
                ASSERT_EQ(expected.lean, kBothShow) << band << " " << h_part;
                continue;
            }
            const int place = 8 * (smooth & ((1 << kLowBits) - 1)) + h_part * (smooth >> 16);
            const std::int32_t both = entries.steps[kSurfaceParts * kStart + static_cast<std::size_t>(place)];
            ASSERT_EQ(both & 0xFFFF, in_16_bits(expected)) << band << " " << h_part;
            ASSERT_EQ(both >> 16 & 0xFFFF, in_16_bits(behind)) << band << " " << h_part;
        }
    }
    EXPECT_LE(column.nearest, nearest / 8);
    EXPECT_GE(column.beyond, beyond);
}

TEST(SurfaceColumn, SaysWhatTheDefinitionSaysOnEverySimdTarget) {
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

TEST(SurfaceColumn, OfARayWithoutAShapeSaysNothing) {
    SurfaceEntries entries;
    entries.hold(1);
    const SurfaceColumn column = lay_nothing(0, entries);
    EXPECT_EQ(column.last, 0);
    EXPECT_EQ(entries.smooth[0], kSurfaceNothing);
    EXPECT_EQ(column.nearest, 256);
    EXPECT_EQ(column.beyond, 0);
}

}  // namespace
}  // namespace rs::engine
