#include "encode/raymap/shape_lines.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace rs::encode {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

struct Box {
    int left, top, width, height;
};

Image<float> depths_of(const std::vector<Box>& boxes) {
    Image<float> depth(200, 100, kNone);
    for (const Box& box : boxes) {
        for (int y = box.top; y < box.top + box.height; ++y) {
            for (int x = box.left; x < box.left + box.width; ++x) depth(x, y) = 0.25F;
        }
    }
    return depth;
}

// A line of 60 x 40 cells.
struct Line {
    LineGrid grid;
    std::vector<ShapeCell> cells;

    Line() : cells(60 * 40) {
        grid.p_cells = 60;
        grid.bands = 40;
    }
    ShapeCell& at(int p, int h) { return cells[static_cast<std::size_t>(p * grid.bands + h)]; }
    void put(const Box& box) {
        for (int p = box.left; p < box.left + box.width; ++p) {
            for (int h = box.top; h < box.top + box.height; ++h) at(p, h) = {.depth = 99, .shown = ShapeCell::kByBoth};
        }
    }
    bool has(int p, int h) { return at(p, h).has_surface(); }
};

const Box kBody{10, 5, 40, 25};  // 1000 cells or pixels

TEST(FloatingCells, IslandsBelowTheShareAreDroppedAndOthersStay) {
    Line line;
    line.put(kBody);
    line.put({55, 5, 3, 3});    // 9: just below a hundredth
    line.put({2, 36, 6, 2});    // 12: just above
    line.put({50, 30, 1, 1});   // touches the body's corner only
    line.put({49, 30, 1, 10});  // a thread connected to the body
    remove_small_components(line.grid, 0.01, line.cells.data());
    EXPECT_FALSE(line.has(56, 6));
    EXPECT_TRUE(line.has(2, 36));
    EXPECT_FALSE(line.has(50, 32)) << "there was none";
    EXPECT_TRUE(line.has(49, 39)) << "a part of the body, however thin";
    EXPECT_TRUE(line.has(50, 30)) << "beside the thread";
    EXPECT_TRUE(line.has(10, 5));
}

TEST(FloatingCells, CornersDoNotHoldIslands) {
    Line line;
    line.put(kBody);
    line.put({50, 30, 2, 2});
    remove_small_components(line.grid, 0.01, line.cells.data());
    EXPECT_FALSE(line.has(50, 30));
    EXPECT_TRUE(line.has(49, 29));
}

TEST(FloatingCells, ALineWithoutSurfacesStaysSo) {
    Line line;
    remove_small_components(line.grid, 0.01, line.cells.data());
    for (const ShapeCell& cell : line.cells) EXPECT_FALSE(cell.has_surface());
}

TEST(FloatingCells, OnePieceAllowsAHundredth) {
    EXPECT_EQ(floating_share(depths_of({kBody})), kMaxFloatingShare);
    EXPECT_EQ(floating_share(depths_of({})), kMaxFloatingShare);
}

TEST(FloatingCells, SmallPartsOfAnObjectAreSafe) {
    EXPECT_DOUBLE_EQ(floating_share(depths_of({{10, 5, 100, 50}, {150, 80, 5, 5}})), 25.0 / 5000 / 2);
    EXPECT_EQ(floating_share(depths_of({{10, 5, 100, 50}, {150, 80, 40, 10}})), kMaxFloatingShare)
        << "a large part changes nothing";
}

TEST(FloatingCells, SinglePixelsAreNoise) {
    EXPECT_EQ(floating_share(depths_of({{10, 5, 100, 50}, {150, 80, 1, 2}})), kMaxFloatingShare);
}

TEST(FloatingCells, BesideTheHullMeansAllNeighboursToo) {
    Line line;
    line.put({20, 10, 8, 8});
    std::vector<std::uint8_t> meets(line.cells.size(), 0);
    for (int p = 20; p < 25; ++p) {
        for (int h = 10; h < 18; ++h) meets[static_cast<std::size_t>(p * line.grid.bands + h)] = 1;
    }
    remove_cells_outside_hull(line.grid, meets, line.cells.data());
    EXPECT_TRUE(line.has(24, 12));
    EXPECT_TRUE(line.has(25, 12)) << "beside a ray that meets the hull";
    EXPECT_FALSE(line.has(26, 12));
}

}  // namespace
}  // namespace rs::encode
