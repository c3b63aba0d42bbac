// Every bit of the board's pictures is that of the scalar definition.

#include "tests/engine/model/board_test_objects.hpp"

#include <random>

namespace rs::engine::model {
namespace {

TEST(BoardEqualityProperty, RandomObjectsAndViews) {
    constexpr std::uint64_t kSeed = 20261121;
    std::mt19937_64 random(kSeed);
    std::int64_t shown = 0;
    int pairs = 0;
    for (int n = 0; n < 100; ++n) {
        const RaySpaceObject object = rs::test::ring_object({.views = 5 + static_cast<int>(random() % 30),
                                                             .width = 8 + static_cast<int>(random() % 70),
                                                             .height = 8 + static_cast<int>(random() % 70),
                                                             .distance = test::in(random, 2, 5),
                                                             .fl_px = test::in(random, 30, 120),
                                                             .planes = 3 + static_cast<int>(random() % 10),
                                                             .x_cells = 32,
                                                             .u_cells = 48,
                                                             .camera_height = test::in(random, -0.3, 0.5),
                                                             .seed = random()});
        const RaySpaceObject stored = with_board_alpha(object);
        Board board(test::prototype());
        const Result<int> slot = board.place(object);
        ASSERT_TRUE(slot.ok()) << slot.error().message;
        std::vector<engine::ViewRegisters> registers;
        std::vector<std::vector<BoardView>> cycles(2);
        for (int v = 0; v < 20; ++v) {
            const Result<engine::ViewRegisters> prepared = prepare_view(object, test::random_upright(random, 80));
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
            for (const Image<Rgba8>& picture : cycle.pictures) {
                const Image<Rgba8> expected = test::defined(stored, registers[at++]);
                ASSERT_EQ(picture, expected) << "seed " << kSeed << ", object " << n << ", view " << at - 1;
                for (const Rgba8& p : expected.pixels()) shown += p.a != 0;
                ++pairs;
            }
        }
    }
    EXPECT_EQ(pairs, 2000);
    EXPECT_GT(shown, 400'000);
}

}  // namespace
}  // namespace rs::engine::model
