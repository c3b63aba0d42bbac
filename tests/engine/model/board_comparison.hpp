#pragma once
// Comparison of a board's images with those of the scalar definition, and of two runs with each other.

#include "tests/engine/model/board_test_objects.hpp"

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace rs::engine::model::test {

// Random object for property tests; at most `most_px` - 1 pixels a side, so that partial tiles occur.
inline rs::test::RingObjectOptions random_ring(std::mt19937_64& random, int fewest_views, int most_px,
                                               double most_fl_px) {
    const auto below = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    return {.views = fewest_views + below(30),
            .width = 8 + below(most_px - 8),
            .height = 8 + below(most_px - 8),
            .distance = in(random, 2, 5),
            .fl_px = in(random, 30, most_fl_px),
            .planes = 3 + below(10),
            .x_cells = 32,
            .u_cells = 48,
            .camera_height = in(random, -0.3, 0.5),
            .seed = random()};
}

struct ComparisonCounts {
    int pairs = 0;           // compared pairs of view and image
    std::int64_t shown = 0;  // total number of non-transparent pixels
};

// Places the object and renders twenty random upright views of at most `most_px` pixels a side in two rendering cycles.
// Every image must equal that of the definition for `stored`, the object as stored by the board.
inline void compare_random_views(Board& board, const RaySpaceObject& object, const RaySpaceObject& stored,
                                 std::mt19937_64& random, int most_px, ComparisonCounts& compared) {
    const Result<int> slot = board.place(object);
    ASSERT_TRUE(slot.ok()) << slot.error().message;
    std::vector<engine::ViewRegisters> registers;
    std::vector<std::vector<BoardView>> cycles(2);
    for (int v = 0; v < 20; ++v) {
        const Result<engine::ViewRegisters> prepared =
            prepare_view(object, random_upright(random, most_px), engine::TexelFilter::kBilinear);
        ASSERT_TRUE(prepared.ok()) << prepared.error().message;
        const Result<BoardView> view = board.view(*slot, *prepared);
        ASSERT_TRUE(view.ok()) << view.error().message;
        registers.push_back(*prepared);
        cycles[static_cast<std::size_t>(v >= 7)].push_back(*view);
    }
    const Result<BoardRun> run = board.render(cycles);
    ASSERT_TRUE(run.ok()) << run.error().message;
    std::size_t at = 0;
    for (const RenderedCycle& cycle : run->cycles) {
        for (const Image<Rgba8>& image : cycle.images) {
            const Image<Rgba8> expected = defined(stored, registers[at++]);
            ASSERT_EQ(image, expected) << "view " << at - 1;
            for (const Rgba8& p : expected.pixels()) compared.shown += p.a != 0;
            ++compared.pairs;
        }
    }
}

// Compares two runs of the same work: every image, its completion time, and the activity counts of every block.
inline void expect_same_run(const BoardRun& run, const BoardRun& expected, const Board& board) {
    ASSERT_EQ(run.cycles.size(), expected.cycles.size());
    for (std::size_t c = 0; c < run.cycles.size(); ++c) {
        EXPECT_EQ(run.cycles[c].started, expected.cycles[c].started);
        EXPECT_EQ(run.cycles[c].rendered, expected.cycles[c].rendered);
        EXPECT_EQ(run.cycles[c].arrived, expected.cycles[c].arrived);
        EXPECT_EQ(run.cycles[c].images, expected.cycles[c].images);
    }
    ASSERT_EQ(run.end.blocks.size(), expected.end.blocks.size());
    for (std::size_t b = 0; b < run.end.blocks.size(); ++b) {
        EXPECT_EQ(run.end.blocks[b].cycles, expected.end.blocks[b].cycles) << board.blocks()[b]->name();
    }
}

}  // namespace rs::engine::model::test
