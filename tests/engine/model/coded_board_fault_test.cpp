// Faults with compressed images: wrong kind of object, replacement of an object, too many objects.

#include "engine/model/limits/coded_layout.hpp"
#include "tests/engine/model/coded_test_objects.hpp"

namespace rs::engine::model {
namespace {

RaySpaceObject small_coded(std::uint64_t seed) {
    return test::random_coded_object({.views = 6, .planes = 4, .x_cells = 16, .u_cells = 16, .seed = seed});
}

void expect_right(Board& board, int slot, const RaySpaceObject& object) {
    const auto prepared = prepare_view(object, test::upright_at(0.4, 3.5, 0, 0.9, 33, 30));
    const Result<BoardRun> run = board.render({{*board.view(slot, *prepared)}});
    ASSERT_TRUE(run.ok()) << run.error().message;
    EXPECT_EQ(run->cycles[0].images[0], test::defined(object, *prepared));
}

TEST(CodedBoardFaults, EachBoardRefusesTheOthersObjectsAndNamesIt) {
    const RaySpaceObject coded = small_coded(1);
    const RaySpaceObject raw = rs::test::ring_object({.views = 6});
    const auto refusal = [](const BoardConfig& config, const RaySpaceObject& object) {
        const Status status = layout_of(config.limits.kind).drawable(object, config.limits);
        return status ? "" : status.error().message;
    };
    EXPECT_EQ(refusal(test::compressed(), coded), "");
    EXPECT_EQ(refusal(test::prototype(), raw), "");
    EXPECT_NE(refusal(test::prototype(), coded).find("use compressed-2000"), std::string::npos);
    EXPECT_NE(refusal(test::compressed(), raw).find("use prototype-2000"), std::string::npos);
    RaySpaceObject dense = raw;
    dense.coded = std::make_shared<codec::CodedImages>();
    EXPECT_NE(refusal(test::prototype(), dense).find("--profile board for compressed-2000"), std::string::npos);
    EXPECT_NE(refusal(test::compressed(), dense).find("of profile dense"), std::string::npos);
    RaySpaceObject partly = coded;
    codec::CodedImages images = *coded.coded;
    images.images[3].tiles.clear();
    partly.coded = std::make_shared<codec::CodedImages>(images);
    EXPECT_NE(refusal(test::compressed(), partly).find("not all of its images are loaded"), std::string::npos);
}

// Same slot, same memory addresses, other codebooks and tiles: no state of the first object may remain in the pipe.
TEST(CodedBoardFaults, AnObjectReplacesAnother) {
    Board board(test::compressed());
    for (std::uint64_t seed = 1; seed < 8; ++seed) {
        const RaySpaceObject object = small_coded(seed);
        const Result<int> slot = board.place(object);
        ASSERT_TRUE(slot.ok());
        EXPECT_EQ(*slot, 0);
        expect_right(board, 0, object);
        EXPECT_EQ(test::block_decompression(board).book_lookup.book_loads(), seed);
        ASSERT_TRUE(board.evict(0).ok());
    }
}

TEST(CodedBoardFaults, BooksAreLoadedWhenTheObjectChangesAndOnlyThen) {
    Board board(test::compressed());
    const RaySpaceObject a = small_coded(11);
    const RaySpaceObject b = small_coded(12);
    const int slot_a = *board.place(a);
    const int slot_b = *board.place(b);
    const auto view = [&](int slot, const RaySpaceObject& object) {
        return *board.view(slot, *prepare_view(object, test::upright_at(0.4, 3.5, 0, 0.9, 33, 30)));
    };
    const BoardView of_a = view(slot_a, a);
    const BoardView of_b = view(slot_b, b);
    const Result<BoardRun> run = board.render({{of_a, of_a, of_b, of_a}, {of_a, of_b}});
    ASSERT_TRUE(run.ok());
    EXPECT_EQ(test::block_decompression(board).book_lookup.book_loads(), 4U);  // a, b, a, b
    const auto prepared = prepare_view(b, test::upright_at(0.4, 3.5, 0, 0.9, 33, 30));
    EXPECT_EQ(run->cycles[0].images[2], test::defined(b, *prepared));
    EXPECT_EQ(run->cycles[1].images[1], test::defined(b, *prepared));
    const auto& ports = board.top().memory().read_ports();
    ASSERT_EQ(ports[3].client, "book_lookup");
    EXPECT_EQ(board.top().memory().counters().words_read[3],
              2 * (book_words(a.coded->board) + book_words(b.coded->board)));
}

TEST(CodedBoardFaults, AHundredAndSixtySlotsAndNoMore) {
    Board board(test::compressed());
    const RaySpaceObject object = small_coded(3);
    for (int n = 0; n < 160; ++n) ASSERT_EQ(*board.place(object), n);
    const Result<int> one_more = board.place(object);
    ASSERT_FALSE(one_more.ok());
    EXPECT_NE(one_more.error().message.find("all 160 object slots"), std::string::npos);
    expect_right(board, 159, object);
}

TEST(CodedBoardFaults, FullMemoryNamesTheRegion) {
    MemorySettings tight = test::compressed().memory;
    tight.shape.row_bits = 1;  // 2048 words to a bank: 8192 of predicted tiles
    MemoryMap map(tight);
    const Result<Placement> none = map.allocate({1, 9000, 1, 1}, "a");
    ASSERT_FALSE(none.ok());
    EXPECT_NE(none.error().message.find("bytes of predicted tiles in one piece"), std::string::npos);
    EXPECT_EQ(map.copies({1, 4096, 1, 1}), 2U);
}

// Memory for finished cycles is bounded.
TEST(CodedBoardFaults, FinishedCyclesAreDropped) {
    Board board(test::compressed());
    const RaySpaceObject object = small_coded(5);
    const int slot = *board.place(object);
    const auto prepared = prepare_view(object, test::upright_at(0.4, 3.5, 0, 0.9, 3, 4));
    const BoardView view = *board.view(slot, *prepared);
    for (int n = 0; n < 10; ++n) ASSERT_TRUE(board.render({{view}, {view}, {view}}).ok());
    EXPECT_EQ(board.top().programs.size(), 30U);
    EXPECT_EQ(board.top().programs.stored(), 0U);
    EXPECT_EQ(board.top().render_control.cycles_begun(), 30U);
    EXPECT_LE(board.top().render_control.cycles().size(), 8U);
}

}  // namespace
}  // namespace rs::engine::model
