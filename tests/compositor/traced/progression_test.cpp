// First image of a view, with simulated clocks.
#include "compositor/traced/progression.hpp"

#include "tests/compositor/traced/small_room.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace rs::compositor {
namespace {

constexpr TracedMethod kPath = TracedMethod::kPath;

TEST(FirstGridSelector, HasAtLeast32CellsAlongTheLongerSide) {
    EXPECT_EQ(FirstGridSelector::coarsest_side(31, 20), 1);
    EXPECT_EQ(FirstGridSelector::coarsest_side(63, 63), 1);
    EXPECT_EQ(FirstGridSelector::coarsest_side(64, 1), 2);
    EXPECT_EQ(FirstGridSelector::coarsest_side(512, 512), 16);
    EXPECT_EQ(FirstGridSelector::coarsest_side(1280, 720), 32);
    EXPECT_EQ(FirstGridSelector::coarsest_side(720, 1280), 32);
    EXPECT_EQ(FirstGridSelector::coarsest_side(100000, 100000), 2048);
    EXPECT_EQ(FirstGridSelector().side(kPath, 1280, 720), 32);  // no measurements
}

TEST(FirstGridSelector, IsTheFinestThatComesInTime) {
    FirstGridSelector grid(0.1);
    // 16 x 16 cells take 1 ms, which predicts 4 ms for 4 times as many.
    grid.record_time(kPath, 512, 512, 32, 0.001);
    EXPECT_EQ(grid.side(kPath, 512, 512), 4);  // 64 ms; 256 ms would exceed the limit
    grid.record_time(kPath, 512, 512, 4, 0.099);
    EXPECT_EQ(grid.side(kPath, 512, 512), 4);
    grid.record_time(kPath, 512, 512, 4, 0.101);
    EXPECT_EQ(grid.side(kPath, 512, 512), 8);
    // In an image with a quarter of the pixels a grid of half the cell size has as many cells.
    grid.record_time(kPath, 512, 512, 4, 0.099);
    EXPECT_EQ(grid.side(kPath, 256, 256), 2);
    // Methods are measured separately.
    EXPECT_EQ(grid.side(TracedMethod::kWhitted, 512, 512), 16);
}

TEST(FirstGridSelector, WhatIsMeasuredCountsMoreThanWhatIsConcluded) {
    // Grids with a constant cost in addition to that of their cells: 20 ms and 1 us.
    FirstGridSelector grid(0.1);
    grid.record_time(kPath, 1024, 1024, 32, 0.021);
    EXPECT_EQ(grid.side(kPath, 1024, 1024), 16);  // 84 ms at most
    for (const int side : {16, 8, 4, 2}) {
        const double cells = 1024.0 * 1024 / side / side;
        grid.record_time(kPath, 1024, 1024, side, 0.02 + 1e-6 * cells);
    }
    EXPECT_EQ(grid.side(kPath, 1024, 1024), 4);  // 86 ms
    // A view that is three times as slow is so at all cell sizes.
    grid.record_time(kPath, 1024, 1024, 4, 3 * 0.0855);
    EXPECT_EQ(grid.side(kPath, 1024, 1024), 16);      // 72 ms; 8 would take 109
    grid.record_time(kPath, 1024, 1024, 16, 0.0241);  // and back
    EXPECT_EQ(grid.side(kPath, 1024, 1024), 4);
}

TEST(FirstGridSelector, ASizeSetByTheUserDoesNotDependOnTimes) {
    FirstGridSelector grid(0.1, 128);
    EXPECT_EQ(grid.side(kPath, 1024, 512), 8);
    grid.record_time(kPath, 1024, 512, 8, 0.0001);
    EXPECT_EQ(grid.side(kPath, 1024, 512), 8) << "fast enough for a finer one";
    grid.record_time(kPath, 1024, 512, 8, 60);
    EXPECT_EQ(grid.side(kPath, 1024, 512), 8) << "too slow";
    EXPECT_EQ(grid.side(kPath, 512, 1023), 4);  // 256 cells; 8 would give 127
    EXPECT_EQ(grid.side(kPath, 100, 100), 1);   // fewer pixels than cells
    EXPECT_EQ(FirstGridSelector(0.1, 1).side(kPath, 1024, 512), 1024);
}

TEST(FirstGridSelector, AClockThatStandsStillBeginsWithWholeImages) {
    FirstGridSelector grid(0.1);
    grid.record_time(kPath, 1024, 1024, 32, 0);
    EXPECT_EQ(grid.side(kPath, 1024, 1024), 1);
    grid.record_time(kPath, 1024, 1024, 1, 5);
    EXPECT_EQ(grid.side(kPath, 1024, 1024), 2);
}

// Runs a view until it has the given number of passes; images take as long as the list states, then as its last entry.
struct Refined {
    std::vector<int> passes;
    std::vector<Image<Rgba8>> images;
};
Refined refined(TracedRenderer& renderer, const Camera& camera, FirstGridSelector& grid, int passes, double seconds) {
    Refined run;
    double now = 0;
    bool begins = true;
    const Clock clock = [&] {
        if (!std::exchange(begins, !begins)) now += seconds;
        return now;
    };
    std::atomic<bool> stop{false};
    refine(renderer, camera, grid, clock, stop, [&](Image<Rgba8> image, int pass) {
        run.passes.push_back(pass);
        run.images.push_back(std::move(image));
        if (pass == passes) stop = true;
    });
    return run;
}

TEST(Refine, EachGridIsTwiceAsFineAndPassesDoNotHangOnTheClock) {
    auto renderer = renderer_of(small_room());
    ASSERT_TRUE(renderer);
    const Camera camera = looking_from({3, 2, 4}, {0, 0.4, 0}, 260);
    FirstGridSelector grid(0.1);
    const Refined slow = refined(*renderer, camera, grid, 2, 1);
    EXPECT_EQ(slow.passes, (std::vector<int>{0, 0, 0, 1, 2}));  // grids of 8, 4, 2
    for (int i = 0, side = 8; i < 3; ++i, side /= 2) {
        const auto coarse = renderer->coarse_image(camera, side);
        ASSERT_TRUE(coarse);
        EXPECT_EQ(slow.images[static_cast<std::size_t>(i)], *coarse);
    }
    // One second per image is too slow for any but the coarsest grid; one millisecond is fast enough for all.
    EXPECT_EQ(refined(*renderer, camera, grid, 1, 0.001).passes.size(), 4U);
    const Refined quick = refined(*renderer, camera, grid, 2, 0.001);
    EXPECT_EQ(quick.passes, (std::vector<int>{1, 2}));
    EXPECT_EQ(quick.images[0], slow.images[3]);
    EXPECT_EQ(quick.images[1], slow.images[4]);
    renderer->begin_image(camera);
    ASSERT_TRUE(renderer->add_pass() && renderer->add_pass());
    EXPECT_EQ(renderer->image(), slow.images[4]);
}

TEST(Refine, BeginsWithTheGridThatTheUserSets) {
    auto renderer = renderer_of(small_room());
    ASSERT_TRUE(renderer);
    const Camera camera = looking_from({3, 2, 4}, {0, 0.4, 0}, 128);
    FirstGridSelector grid(0.1, 64);
    const Refined run = refined(*renderer, camera, grid, 1, 1);
    EXPECT_EQ(run.passes, (std::vector<int>{0, 1}));  // cells of 2x2 pixels; of 4x4 by default
    const auto coarse = renderer->coarse_image(camera, 2);
    ASSERT_TRUE(coarse);
    EXPECT_EQ(run.images[0], *coarse);
}

TEST(Refine, EndsWhereItIsStopped) {
    auto renderer = renderer_of(small_room());
    ASSERT_TRUE(renderer);
    FirstGridSelector grid;
    std::atomic<bool> stop{false};
    int images = 0;
    refine(
        *renderer, looking_from({3, 2, 4}, {0, 0.4, 0}, 100), grid, [] { return 0.0; }, stop,
        [&](const Image<Rgba8>&, int pass) {
            EXPECT_EQ(pass, 0);
            ++images;
            stop = true;
        });
    EXPECT_EQ(images, 1);
}

}  // namespace
}  // namespace rs::compositor
