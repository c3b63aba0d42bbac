// The board's images equal those of the scalar definition bit for bit.

#include "tests/engine/model/board_comparison.hpp"

namespace rs::engine::model {
namespace {

TEST(BoardEqualityProperty, RandomObjectsAndViews) {
    constexpr std::uint64_t kSeed = 20261121;
    std::mt19937_64 random(kSeed);
    test::ComparisonCounts compared;
    for (int n = 0; n < 100; ++n) {
        SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", object " << n);
        const RaySpaceObject object = rs::test::ring_object(test::random_ring(random, 5, 78, 120));
        Board board(test::prototype());
        ASSERT_NO_FATAL_FAILURE(
            test::compare_random_views(board, object, with_board_alpha(object), random, 80, compared));
    }
    EXPECT_EQ(compared.pairs, 2000);
    EXPECT_GT(compared.shown, 400'000);
}

}  // namespace
}  // namespace rs::engine::model
