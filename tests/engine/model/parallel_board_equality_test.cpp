// Every bit of the parallel board's pictures is that of the scalar definition: raw and coded pictures, with a shape map
// and without, any number of pipes.

#include "tests/engine/model/parallel_test_objects.hpp"

namespace rs::engine::model {
namespace {

struct Seen {
    int pairs = 0;
    std::int64_t shown = 0;
    std::uint64_t sent_back = 0;
    std::uint64_t of_last_hop = 0;
};

// 25 objects and 20 views of each: 500 pairs.
Seen compare(const test::AnyObject& kind, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Seen seen;
    for (int n = 0; n < 25; ++n) {
        const RaySpaceObject object = test::any_object({.views = 2 + static_cast<int>(random() % 30),
                                                        .width = 8 + static_cast<int>(random() % 70),
                                                        .height = 8 + static_cast<int>(random() % 70),
                                                        .distance = test::in(random, 2, 5),
                                                        .fl_px = test::in(random, 30, 120),
                                                        .planes = 3 + static_cast<int>(random() % 10),
                                                        .x_cells = 32,
                                                        .u_cells = 48,
                                                        .camera_height = test::in(random, -0.3, 0.5),
                                                        .seed = random()},
                                                       kind, n % 3 == 0);
        Board board(test::parallel(1 + n % 5));
        const Result<int> slot = board.place(object);
        if (!slot) {
            ADD_FAILURE() << slot.error().message;
            return seen;
        }
        std::vector<engine::ViewRegisters> registers;
        std::vector<std::vector<BoardView>> cycles(2);
        for (int v = 0; v < 20; ++v) {
            const Result<engine::ViewRegisters> prepared = prepare_view(object, test::random_upright(random, 60));
            EXPECT_TRUE(prepared.ok());
            registers.push_back(*prepared);
            cycles[static_cast<std::size_t>(v >= 7)].push_back(*board.view(*slot, *prepared));
        }
        const Result<BoardRun> run = board.render(cycles);
        if (!run) {
            ADD_FAILURE() << run.error().message;
            return seen;
        }
        for (const RenderedCycle& cycle : run->cycles) {
            for (const Image<Rgba8>& picture : cycle.pictures) {
                const std::size_t at = static_cast<std::size_t>(seen.pairs) % 20;
                const Image<Rgba8> expected = test::defined(object, registers[at]);
                EXPECT_EQ(picture, expected) << "seed " << seed << ", object " << n << ", view " << at;
                for (const Rgba8& p : expected.pixels()) seen.shown += p.a != 0;
                ++seen.pairs;
            }
        }
        for (const auto& pipe : board.top().parallel->pipes) {
            seen.sent_back += pipe->layer_choice.sent_back();
            seen.of_last_hop += pipe->chains.fifos[3]->records.pushed_in_all();
        }
    }
    return seen;
}

TEST(ParallelBoardEqualityProperty, RawPicturesOnPlanes) {
    const Seen seen = compare({.coded = false, .shape = false}, 20261123);
    EXPECT_EQ(seen.pairs, 500);
    EXPECT_GT(seen.shown, 60'000);
}

TEST(ParallelBoardEqualityProperty, CodedPicturesOnPlanes) {
    const Seen seen = compare({.coded = true, .shape = false}, 20261124);
    EXPECT_EQ(seen.pairs, 500);
    EXPECT_GT(seen.shown, 30'000);
    EXPECT_GT(seen.of_last_hop, 1000U);  // predictions of three hops
}

TEST(ParallelBoardEqualityProperty, RawPicturesWithShapeMaps) {
    const Seen seen = compare({.coded = false, .shape = true}, 20261125);
    EXPECT_EQ(seen.pairs, 500);
    EXPECT_GT(seen.shown, 60'000);
    EXPECT_GT(seen.sent_back, 10'000U);  // cells that did not answer
}

TEST(ParallelBoardEqualityProperty, CodedPicturesWithShapeMaps) {
    const Seen seen = compare({.coded = true, .shape = true}, 20261126);
    EXPECT_EQ(seen.pairs, 500);
    EXPECT_GT(seen.shown, 30'000);
    EXPECT_GT(seen.of_last_hop, 1000U);
}

// Objects of all four kinds in one rendering cycle; more of them than there are sets of codebooks; from the disk.
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
        registers.push_back(*prepare_view(objects[n], test::upright_at(0.3 * double(v), 3.5, 0.1, 0.9, side, 33)));
        cycles[v / 13].push_back(*board.view(slots[n], registers.back()));
    }
    const Result<BoardRun> run = board.render(cycles);
    ASSERT_TRUE(run.ok()) << run.error().message;
    for (std::size_t v = 0; v < 26; ++v) {
        EXPECT_EQ(run->cycles[v / 13].pictures[v % 13], test::defined(objects[v * v % 6], registers[v])) << v;
    }
}

}  // namespace
}  // namespace rs::engine::model
