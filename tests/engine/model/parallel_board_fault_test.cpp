// Faults on the parallel board.

#include "tests/engine/model/parallel_test_objects.hpp"

namespace rs::engine::model {
namespace {

RaySpaceObject small_for_pipes(std::uint64_t seed, bool coded = true) {
    return test::any_object({.views = 6, .planes = 4, .x_cells = 16, .u_cells = 16, .seed = seed},
                            {.coded = coded, .shape = true});
}

engine::ViewRegisters view_of(const RaySpaceObject& object, int side = 40) {
    return *prepare_view(object, test::upright_at(0.4, 3.5, 0, 0.9, side, side), engine::TexelFilter::kBilinear);
}

void expect_right_in_parallel(Board& board, int slot, const RaySpaceObject& object) {
    const engine::ViewRegisters view = view_of(object);
    const Result<BoardRun> run = board.render({{*board.view(slot, view)}});
    ASSERT_TRUE(run.ok()) << run.error().message;
    EXPECT_EQ(run->cycles[0].images[0], test::defined(object, view));
}

std::string refusal(const RaySpaceObject& object) {
    const Status status = layout_of(BoardKind::any_object).drawable(object, test::parallel().limits);
    return status ? "" : status.error().message;
}

TEST(ParallelBoardFaults, RefusesUnsupportedObjectsWithAReason) {
    EXPECT_EQ(refusal(small_for_pipes(1)), "");
    EXPECT_EQ(refusal(small_for_pipes(1, false)), "");
    RaySpaceObject dense = small_for_pipes(1, false);
    dense.coded = std::make_shared<codec::CodedImages>();
    EXPECT_NE(refusal(dense).find("of profile dense"), std::string::npos);
    RaySpaceObject tall = small_for_pipes(1, false);
    tall.rings.front().shape.bands = 385;
    EXPECT_NE(refusal(tall).find("bands of height in its shape map: 385, more than the board's 384"),
              std::string::npos);
    RaySpaceObject missing = small_for_pipes(1, false);
    missing.images[2] = {};
    EXPECT_NE(refusal(missing).find("not all of its images are loaded"), std::string::npos);
    RaySpaceObject rings = small_for_pipes(1, false);
    rings.rings.push_back(rings.rings.front());
    EXPECT_NE(refusal(rings).find("rings of views: 2"), std::string::npos);
    // The boards of 2000 name this one.
    const Status published =
        layout_of(BoardKind::raw_images).drawable(small_for_pipes(1, false), test::prototype().limits);
    EXPECT_NE(published.error().message.find("or use parallel"), std::string::npos);
    const RaySpaceObject object = small_for_pipes(1);
    Camera camera = test::upright_at(0.4, 3.5, 0, 0.9, 40, 40);
    camera = look_at_camera({1, 2, 3}, {0, 0, 0}, 0.7, 40, 40);
    const Result<BoardView> tilted = board_view(*prepare_view(object, camera, engine::TexelFilter::kBilinear), 0);
    ASSERT_FALSE(tilted.ok());
    EXPECT_NE(tilted.error().message.find("tilted"), std::string::npos);
}

// Same slot, same memory addresses, other codebooks, texels and cells: no state of the first object may remain in a
// pipe.
TEST(ParallelBoardFaults, AnObjectReplacesAnother) {
    Board board(test::parallel(3));
    for (std::uint64_t seed = 1; seed < 8; ++seed) {
        const RaySpaceObject object = small_for_pipes(seed, seed % 3 != 0);
        const Result<int> slot = board.place(object);
        ASSERT_TRUE(slot.ok());
        EXPECT_EQ(*slot, 0);
        expect_right_in_parallel(board, 0, object);
        expect_right_in_parallel(board, 0, object);
        ASSERT_TRUE(board.evict(0).ok());
    }
}

TEST(ParallelBoardFaults, ALoadWithoutDataFailsAndTheSlotIsFree) {
    BoardConfig config = test::parallel(2);
    config.disk.stall_after_bytes = 4096;
    config.disk.stall_cycles = 100'000;
    config.disk.timeout_cycles = 20'000;
    Board board(config);
    const RaySpaceObject object = small_for_pipes(3);
    ASSERT_TRUE(board.start_load(object).ok());
    const Status failed = board.finish_loads();
    ASSERT_FALSE(failed.ok());
    EXPECT_NE(failed.error().message.find("load the object once more"), std::string::npos);
    EXPECT_FALSE(board.top().registers.objects[0].valid);
    const Result<BoardRun> run = board.render({{*board.view(0, view_of(object))}});
    ASSERT_FALSE(run.ok());
    EXPECT_NE(run.error().message.find("holds no object"), std::string::npos);
    EXPECT_EQ(*board.place(object), 0);
    expect_right_in_parallel(board, 0, object);
}

// Loading uses the maintenance windows of all channels and costs no rendering cycle.
TEST(ParallelBoardFaults, LoadingDisturbsNothing) {
    const RaySpaceObject shown = small_for_pipes(1);
    const RaySpaceObject loaded = small_for_pipes(2);
    const auto cycles_of = [&](bool loading) {
        Board board(test::parallel(3));
        const int slot = *board.place(shown);
        if (loading) {
            EXPECT_TRUE(board.start_load(loaded).ok());
        }
        const Result<BoardRun> run = board.render({{*board.view(slot, view_of(shown, 90))}});
        EXPECT_TRUE(run.ok());
        EXPECT_EQ(board.top().memory(2).counters().load_words > 1000, loading);
        EXPECT_NEAR(double(board.top().memory(0).counters().load_words),
                    double(board.top().memory(2).counters().load_words), 20);
        return run->cycles[0].render_cycles();
    };
    EXPECT_EQ(cycles_of(true), cycles_of(false));
}

TEST(ParallelBoardFaults, ARetryOfTheBusLosesNothing) {
    BoardConfig config = test::parallel(3);
    config.pci.retry_every = 3;
    Board board(config);
    const RaySpaceObject object = small_for_pipes(5);
    expect_right_in_parallel(board, *board.place(object), object);
    EXPECT_GT(board.top().host_bus.counters().retries, 5U);
}

TEST(ParallelBoardFaults, AThirdCycleIsRefusedAndTheFirstTwoAreComplete) {
    Board board(test::parallel(3));
    const RaySpaceObject object = small_for_pipes(6);
    const BoardView view = *board.view(*board.place(object), view_of(object));
    for (int n = 0; n < 4; ++n) board.submit({view});
    const auto refused = [&] { return board.top().render_control.refusals().size() >= 1; };
    ASSERT_TRUE(board.top().simulator.run_until(refused, 1'000'000).ok());
    EXPECT_NE(board.top().render_control.refusals()[0].reason.find("queue overrun"), std::string::npos);
}

// A pipe without memory answers stalls: the run fails with the contents of every FIFO.
TEST(ParallelBoardFaults, AStallIsReportedWithEveryFifo) {
    BoardConfig config = test::parallel(2);
    config.no_progress_cycles = 1000;
    Board board(config);
    const auto never = [] { return false; };
    const Status status = board.top().simulator.run_until(never, 100'000);
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().message.find("waiting_p1: 0 of 512"), std::string::npos);
    EXPECT_NE(status.error().message.find("[patch_store_p0]"), std::string::npos);
}

}  // namespace
}  // namespace rs::engine::model
