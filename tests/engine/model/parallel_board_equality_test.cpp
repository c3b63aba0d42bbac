// Images of the parallel board equal those of the scalar definition bit for bit: raw and coded images, with and without
// a shape map, any number of pipes.

#include "tests/engine/model/board_comparison.hpp"
#include "tests/engine/model/parallel_test_objects.hpp"

namespace rs::engine::model {
namespace {

struct EventCounts : test::ComparisonCounts {
    std::uint64_t sent_back = 0;
    std::uint64_t of_last_hop = 0;
};

// 25 objects and 20 views of each: 500 pairs.
void compare(const test::AnyObject& kind, std::uint64_t seed, EventCounts& counts) {
    std::mt19937_64 random(seed);
    for (int n = 0; n < 25; ++n) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", object " << n);
        const RaySpaceObject object = test::any_object(test::random_ring(random, 2, 78, 120), kind, n % 3 == 0);
        Board board(test::parallel(1 + n % 5));
        ASSERT_NO_FATAL_FAILURE(test::compare_random_views(board, object, object, random, 60, counts));
        for (const auto& pipe : test::pipes(board)) {
            counts.sent_back += pipe->surface_blend.sent_back();
            counts.of_last_hop += pipe->chains.hop_fifos[3]->records.total_pushed();
        }
    }
}

TEST(ParallelBoardEqualityProperty, RawImagesOnPlanes) {
    EventCounts counts;
    ASSERT_NO_FATAL_FAILURE(compare({.coded = false, .shape = false}, 20261123, counts));
    EXPECT_EQ(counts.pairs, 500);
    EXPECT_GT(counts.shown, 60'000);
}

TEST(ParallelBoardEqualityProperty, CodedImagesOnPlanes) {
    EventCounts counts;
    ASSERT_NO_FATAL_FAILURE(compare({.coded = true, .shape = false}, 20261124, counts));
    EXPECT_EQ(counts.pairs, 500);
    EXPECT_GT(counts.shown, 30'000);
    EXPECT_GT(counts.of_last_hop, 1000U);  // predictions of three hops
}

TEST(ParallelBoardEqualityProperty, RawImagesWithShapeMaps) {
    EventCounts counts;
    ASSERT_NO_FATAL_FAILURE(compare({.coded = false, .shape = true}, 20261125, counts));
    EXPECT_EQ(counts.pairs, 500);
    EXPECT_GT(counts.shown, 60'000);
    EXPECT_GT(counts.sent_back, 10'000U);  // transparent surfaces
}

TEST(ParallelBoardEqualityProperty, CodedImagesWithShapeMaps) {
    EventCounts counts;
    ASSERT_NO_FATAL_FAILURE(compare({.coded = true, .shape = true}, 20261126, counts));
    EXPECT_EQ(counts.pairs, 500);
    EXPECT_GT(counts.shown, 30'000);
    EXPECT_GT(counts.of_last_hop, 1000U);
}

// Objects of all four kinds in one rendering cycle; more than there are sets of codebooks; loaded from the disk.
TEST(ParallelBoardEquality, ManyObjectsInOneCycleFromTheDisk) {
    Board board(test::parallel());
    std::vector<RaySpaceObject> objects;
    std::vector<int> slots;
    for (std::uint64_t n = 0; n < 6; ++n) {
        objects.push_back(test::any_object({.views = 6, .planes = 4, .x_cells = 16, .u_cells = 16, .seed = 70 + n},
                                           {.coded = n != 1, .shape = n % 2 == 0}));
        const Result<int> slot = board.start_load(objects.back());
        ASSERT_TRUE(slot.ok()) << slot.error().message;
        slots.push_back(*slot);
    }
    ASSERT_TRUE(board.finish_loads().ok());
    std::vector<std::vector<BoardView>> cycles(2);
    std::vector<engine::ViewRegisters> registers;
    for (std::size_t v = 0; v < 26; ++v) {
        const std::size_t n = v * v % 6;
        const int side = v % 5 == 0 ? 200 : 17 + static_cast<int>(v);
        registers.push_back(*prepare_view(objects[n], test::upright_at(0.3 * double(v), 3.5, 0.1, 0.9, side, 33),
                                          engine::TexelFilter::kBilinear));
        cycles[v / 13].push_back(*board.view(slots[n], registers.back()));
    }
    const Result<BoardRun> run = board.render(cycles);
    ASSERT_TRUE(run.ok()) << run.error().message;
    for (std::size_t v = 0; v < 26; ++v) {
        EXPECT_EQ(run->cycles[v / 13].images[v % 13], test::defined(objects[v * v % 6], registers[v])) << v;
    }
}

}  // namespace
}  // namespace rs::engine::model
