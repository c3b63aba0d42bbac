// Fault handling of the board: a stated refusal or a delay, never a torn image.

#include "tests/engine/model/board_test_objects.hpp"

namespace rs::engine::model {
namespace {

RaySpaceObject small_plane(std::uint64_t seed = 1) {
    return rs::test::ring_object({.views = 12, .planes = 6, .x_cells = 32, .u_cells = 32, .seed = seed});
}

Camera camera_at(double azimuth) {
    return test::upright_at(azimuth, 3.5, 0, 0.9, 33, 30);
}

BoardView view_of(const Board& board, int slot, const RaySpaceObject& object, double azimuth) {
    return *board.view(slot, *prepare_view(object, camera_at(azimuth)));
}

void expect_right(const Image<Rgba8>& image, const RaySpaceObject& object, double azimuth) {
    EXPECT_EQ(image, test::defined(with_board_alpha(object), *prepare_view(object, camera_at(azimuth))));
}

TEST(BoardFaults, BusRetriesCostClocksAndNoBits) {
    const RaySpaceObject object = small_plane();
    std::uint64_t arrived[2] = {0, 0};
    for (const int retry_every : {0, 3}) {
        BoardConfig config = test::prototype();
        config.pci.retry_every = retry_every;
        Board board(config);
        const int slot = *board.place(object);
        const Result<BoardRun> run = board.render({{view_of(board, slot, object, 0.5)}});
        ASSERT_TRUE(run.ok());
        expect_right(run->cycles[0].images[0], object, 0.5);
        arrived[retry_every > 0] = run->cycles[0].arrived;
        const HostBus::Counters& bus = board.top().host_bus.counters();
        EXPECT_EQ(bus.retries, retry_every > 0 ? bus.bursts / 3 : 0);
        EXPECT_EQ(bus.image_bytes, 33U * 15U * 8U);
    }
    EXPECT_GT(arrived[1], arrived[0]);
}

TEST(BoardFaults, ADiskThatPausesDelaysTheObjectAndNothingElse) {
    BoardConfig config = test::prototype();
    config.disk.stall_after_bytes = 2048;
    config.disk.stall_cycles = 100'000;
    Board board(config);
    const RaySpaceObject object = small_plane();
    const Result<int> slot = board.start_load(object);
    ASSERT_TRUE(slot.ok());
    ASSERT_TRUE(board.finish_loads().ok());
    const DiskController::Load& load = board.top().disk_controller.loads().front();
    EXPECT_FALSE(load.failed);
    EXPECT_GT(load.underrun_cycles, 90'000U);
    const Result<BoardRun> run = board.render({{view_of(board, *slot, object, 1.5)}});
    ASSERT_TRUE(run.ok());
    expect_right(run->cycles[0].images[0], object, 1.5);
}

TEST(BoardFaults, ADiskTimeoutFailsTheLoadAndFreesTheSlot) {
    BoardConfig config = test::prototype();
    config.disk.stall_after_bytes = 2048;
    config.disk.stall_cycles = 1'000'000'000;
    config.disk.timeout_cycles = 50'000;
    Board board(config);
    const RaySpaceObject object = small_plane();
    const std::uint64_t free = board.memory_map().free_words(Region::luma);
    const Result<int> slot = board.start_load(object);
    ASSERT_TRUE(slot.ok());
    const Status status = board.finish_loads();
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().message.find("delivered no data before the timeout"), std::string::npos);
    EXPECT_EQ(board.memory_map().free_words(Region::luma), free);
    EXPECT_FALSE(board.top().registers.objects[static_cast<std::size_t>(*slot)].valid);
    const Result<BoardRun> run = board.render({{view_of(board, *slot, object, 0)}});
    ASSERT_FALSE(run.ok());
    EXPECT_NE(run.error().message.find("holds no object"), std::string::npos);
}

TEST(BoardFaults, AnObjectIsNotDrawnBeforeItsLastWord) {
    Board board(test::prototype());
    const RaySpaceObject object = small_plane();
    const Result<int> slot = board.start_load(object);
    ASSERT_TRUE(slot.ok());
    const Result<BoardRun> early = board.render({{view_of(board, *slot, object, 0)}});
    ASSERT_FALSE(early.ok());
    EXPECT_NE(early.error().message.find("holds no object"), std::string::npos);
    EXPECT_FALSE(board.evict(*slot).ok());  // being loaded
    ASSERT_TRUE(board.finish_loads().ok());
    EXPECT_TRUE(board.render({{view_of(board, *slot, object, 0)}}).ok());
}

TEST(BoardFaults, AFullMemoryOrAFullTableRefusesTheObjectAndKeepsTheOthers) {
    BoardConfig config = test::prototype();
    config.memory.shape.row_bits = 14;
    config.memory.shape.column_bits = 8;
    config.limits.image_buffer_side_px = 64;
    config.limits.objects = 2;
    const std::uint64_t small_bank = config.memory.shape.words_per_bank();
    ASSERT_GT(small_bank, 0U);
    Board board(config);
    const RaySpaceObject object = small_plane();
    ASSERT_TRUE(board.place(object).ok());
    ASSERT_TRUE(board.place(object).ok());
    const Result<int> third = board.place(object);
    ASSERT_FALSE(third.ok());
    EXPECT_NE(third.error().message.find("all 2 object slots"), std::string::npos);

    MemorySettings tight;
    tight.shape.row_bits = 1;  // 2048 words to a bank: 16384 of luma
    MemoryMap map(tight);
    const std::array<std::uint64_t, kObjectRegions> words = {10'000, 100, 100, 100};
    const Result<Placement> first = map.allocate(words, "a");
    ASSERT_TRUE(first.ok());
    const Result<Placement> second = map.allocate(words, "b");
    ASSERT_FALSE(second.ok());
    EXPECT_NE(second.error().message.find("b: board memory is full: it needs 80000 bytes of luma"), std::string::npos);
    EXPECT_EQ(map.free_words(Region::chroma), map.capacity_words(Region::chroma) - 100);  // nothing was taken
    map.release(*first);
    EXPECT_TRUE(map.allocate(words, "b").ok());
}

TEST(BoardFaults, BadRegistersRefuseTheWholeCycle) {
    Board board(test::prototype());
    const RaySpaceObject object = small_plane();
    const int slot = *board.place(object);
    const BoardView good = view_of(board, slot, object, 0);
    const auto refusal = [&](const BoardView& bad) {
        const Result<BoardRun> run = board.render({{good, bad}});
        return run ? "" : run.error().message;
    };
    BoardView bad = good;
    bad.object = 7;
    EXPECT_NE(refusal(bad).find("view 1: object slot 7 holds no object"), std::string::npos);
    bad.object = 99;
    EXPECT_NE(refusal(bad).find("object slot 99"), std::string::npos);
    bad = good;
    bad.width = 513;
    EXPECT_NE(refusal(bad).find("size 513x30 is outside 1..512"), std::string::npos);
    bad.width = 0;
    EXPECT_NE(refusal(bad).find("size 0x30"), std::string::npos);
    bad = good;
    bad.planes[5].n0_q32 = std::int64_t{1} << 35;
    EXPECT_NE(refusal(bad).find("more bits than its register"), std::string::npos);
    bad.planes[5].n0_q32 = (std::int64_t{1} << 35) - 1;
    bad.planes[5].nx_q32 = 1;  // exceeds the register width within the view
    EXPECT_NE(refusal(bad).find("more bits than its register"), std::string::npos);
    const Result<BoardRun> many = board.render({std::vector<BoardView>(16, good)});
    ASSERT_FALSE(many.ok());
    EXPECT_NE(many.error().message.find("16 views, outside 1..15"), std::string::npos);
    EXPECT_TRUE(board.top().render_control.cycles().empty());
    EXPECT_EQ(board.top().memory().counters().image_words, 0U);
    const Result<BoardRun> run = board.render({{good}});  // the board continues
    ASSERT_TRUE(run.ok());
    expect_right(run->cycles[0].images[0], object, 0);
}

TEST(BoardFaults, AThirdCycleOverrunsTheQueueAndTheOthersAreComplete) {
    Board board(test::prototype());
    const RaySpaceObject object = small_plane();
    const int slot = *board.place(object);
    for (int n = 0; n < 3; ++n) board.submit({view_of(board, slot, object, n)});
    const RenderControl& control = board.top().render_control;
    const auto& images = board.top().host_bus.images();
    const auto done = [&] {
        return images.size() == 2 && images.back().words.size() == images.back().expected_words &&
               control.refusals().size() == 1;
    };
    ASSERT_TRUE(board.top().simulator.run_until(done, 10'000'000).ok());
    EXPECT_EQ(control.refusals()[0].program, 2U);
    EXPECT_NE(control.refusals()[0].reason.find("queue overrun"), std::string::npos);
    EXPECT_EQ(control.cycles().size(), 2U);
    for (int n = 0; n < 2; ++n) {
        const Image<Rgba8> expected = test::defined(with_board_alpha(object), *prepare_view(object, camera_at(n)));
        const std::uint64_t word = images[static_cast<std::size_t>(n)].words[15 * 16 + 7];
        EXPECT_EQ(static_cast<std::uint8_t>(word), expected(16, 14).r);
        EXPECT_EQ(static_cast<std::uint8_t>(word >> 56), expected(16, 15).a);
    }
}

TEST(BoardFaults, AnObjectInUseIsNotEvicted) {
    Board board(test::prototype());
    const RaySpaceObject object = small_plane();
    const int slot = *board.place(object);
    board.submit({view_of(board, slot, object, 0)});
    EXPECT_FALSE(board.evict(slot).ok());  // its command is still on the bus
    const RenderControl& control = board.top().render_control;
    ASSERT_TRUE(board.top().simulator.run_until([&] { return !control.cycles().empty(); }, 1'000'000).ok());
    const Status status = board.evict(slot);
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().message.find("is being drawn"), std::string::npos);
    ASSERT_TRUE(board.top().simulator.run_until([&] { return control.cycles()[0].rendered != 0; }, 1'000'000).ok());
    EXPECT_TRUE(board.evict(slot).ok());
    EXPECT_FALSE(board.evict(slot).ok());
}

TEST(BoardFaults, ObjectsThatTheBoardCannotDrawAreRefusedWithTheRemedy) {
    Board board(test::prototype());
    RaySpaceObject shaped = small_plane();
    shaped.rings.front().shape.gaps.resize(1);
    EXPECT_NE(board.place(shaped).error().message.find("--raymap plane"), std::string::npos);
    RaySpaceObject unloaded = small_plane();
    unloaded.images[3] = {};
    EXPECT_NE(board.place(unloaded).error().message.find("not all of its images"), std::string::npos);
    RaySpaceObject full_colour = small_plane();
    full_colour.images[0].chroma_shift = 0;
    EXPECT_NE(board.place(full_colour).error().message.find("colour at full size"), std::string::npos);
    EXPECT_NE(board.place(rs::test::ring_object({.planes = 13})).error().message.find("--planes"), std::string::npos);
    const RaySpaceObject object = small_plane();
    const Camera tilted = look_at_camera({3, 1, 0}, {0, 0, 0}, 0.6, 32, 32);
    const Result<BoardView> view = board.view(0, *prepare_view(object, tilted));
    ASSERT_FALSE(view.ok());
    EXPECT_NE(view.error().message.find("tilted"), std::string::npos);
}

// The host never receives images: the bus is blocked by a target that is never ready.
TEST(BoardFaults, AStalledBoardReportsTheStateOfEveryBlock) {
    BoardConfig config = test::prototype();
    config.no_progress_cycles = 2000;
    Board board(config);
    const RaySpaceObject object = small_plane();
    const int slot = *board.place(object);
    board.top().image_words.push({0, false, false});  // a word without a header: the bus waits for a header forever
    board.top().image_words.commit_writer();
    const Result<BoardRun> run = board.render({{view_of(board, slot, object, 0)}});
    ASSERT_FALSE(run.ok());
    const std::string& message = run.error().message;
    EXPECT_NE(message.find("made no progress for 2000 cycles"), std::string::npos);
    EXPECT_NE(message.find("image_words: 32 of 32"), std::string::npos);
    EXPECT_NE(message.find("[host_dma] output_full"), std::string::npos);
    EXPECT_NE(message.find("[host_bus] idle"), std::string::npos);
}

}  // namespace
}  // namespace rs::engine::model
