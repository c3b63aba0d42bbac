// Images that the board decompresses equal, bit for bit, those of the definition for the object that rayspace/codec
// decodes.

#include "tests/engine/model/board_comparison.hpp"
#include "tests/engine/model/coded_test_objects.hpp"

namespace rs::engine::model {
namespace {

TEST(CodedBoardEqualityProperty, RandomTilesAndViews) {
    constexpr std::uint64_t kSeed = 20261122;
    std::mt19937_64 random(kSeed);
    test::ComparisonCounts compared;
    std::uint64_t of_last_hop = 0;
    for (int n = 0; n < 100; ++n) {
        SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", object " << n);
        const RaySpaceObject object = test::random_coded_object(test::random_ring(random, 2, 118, 160));
        Board board(test::compressed());
        ASSERT_NO_FATAL_FAILURE(test::compare_random_views(board, object, object, random, 60, compared));
        of_last_hop += test::block_decompression(board).hop_fifos[3]->records.total_pushed();
    }
    EXPECT_EQ(compared.pairs, 2000);
    EXPECT_GT(compared.shown, 100'000);
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
        EXPECT_EQ(run->cycles[0].images[0], test::defined(object, *prepared));
    }
}

}  // namespace
}  // namespace rs::engine::model
