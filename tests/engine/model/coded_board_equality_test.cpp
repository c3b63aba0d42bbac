// Every bit of pictures that the board unpacks itself is that of the definition, on the object that rayspace/codec
// unpacks.

#include "tests/engine/model/coded_test_objects.hpp"

namespace rs::engine::model {
namespace {

TEST(CodedBoardEqualityProperty, RandomTilesAndViews) {
    constexpr std::uint64_t kSeed = 20261122;
    std::mt19937_64 random(kSeed);
    std::int64_t shown = 0;
    std::uint64_t of_last_hop = 0;
    int pairs = 0;
    for (int n = 0; n < 100; ++n) {
        const RaySpaceObject object = test::random_coded_object({.views = 2 + static_cast<int>(random() % 30),
                                                                 .width = 8 + static_cast<int>(random() % 110),
                                                                 .height = 8 + static_cast<int>(random() % 110),
                                                                 .distance = test::in(random, 2, 5),
                                                                 .fl_px = test::in(random, 30, 160),
                                                                 .planes = 3 + static_cast<int>(random() % 10),
                                                                 .x_cells = 32,
                                                                 .u_cells = 48,
                                                                 .camera_height = test::in(random, -0.3, 0.5),
                                                                 .seed = random()});
        Board board(test::compressed());
        const Result<int> slot = board.place(object);
        ASSERT_TRUE(slot.ok()) << slot.error().message;
        std::vector<engine::ViewRegisters> registers;
        std::vector<std::vector<BoardView>> cycles(2);
        for (int v = 0; v < 20; ++v) {
            const Result<engine::ViewRegisters> prepared = prepare_view(object, test::random_upright(random, 60));
            ASSERT_TRUE(prepared.ok()) << prepared.error().message;
            registers.push_back(*prepared);
            cycles[static_cast<std::size_t>(v >= 7)].push_back(*board.view(*slot, *prepared));
        }
        const Result<BoardRun> run = board.render(cycles);
        ASSERT_TRUE(run.ok()) << run.error().message;
        std::size_t at = 0;
        for (const RenderedCycle& cycle : run->cycles) {
            for (const Image<Rgba8>& picture : cycle.pictures) {
                const Image<Rgba8> expected = test::defined(object, registers[at++]);
                ASSERT_EQ(picture, expected) << "seed " << kSeed << ", object " << n << ", view " << at - 1;
                for (const Rgba8& p : expected.pixels()) shown += p.a != 0;
                ++pairs;
            }
        }
        of_last_hop += board.top().single->pipe.block_decompression->fifos[3]->records.pushed_in_all();
    }
    EXPECT_EQ(pairs, 2000);
    EXPECT_GT(shown, 100'000);
    EXPECT_GT(of_last_hop, 1000U);  // predictions of three hops
}

TEST(CodedBoardEquality, AnEncodedObjectFromTheDisk) {
    const RaySpaceObject object = test::encoded_object(20, 96).coded;
    Board board(test::compressed());
    const Result<int> slot = board.start_load(object);
    ASSERT_TRUE(slot.ok()) << slot.error().message;
    ASSERT_TRUE(board.finish_loads().ok());
    for (const int side : {1, 7, 33, 96, 200}) {
        const auto prepared = prepare_view(object, test::upright_at(0.3 * side, 3.5, 0.1, 0.9, side, side));
        const Result<BoardRun> run = board.render({{*board.view(*slot, *prepared)}});
        ASSERT_TRUE(run.ok()) << run.error().message;
        EXPECT_EQ(run->cycles[0].pictures[0], test::defined(object, *prepared));
    }
}

}  // namespace
}  // namespace rs::engine::model
