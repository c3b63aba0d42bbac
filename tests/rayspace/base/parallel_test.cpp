#include "rayspace/base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace rs {
namespace {

TEST(ForEachInParallel, DoesEveryPieceOnce) {
    std::vector<std::atomic<int>> done(500);
    EXPECT_TRUE(for_each_in_parallel(500, "work", nullptr, [&](int i) -> Status {
                    ++done[static_cast<std::size_t>(i)];
                    return {};
                }).ok());
    for (const auto& count : done) EXPECT_EQ(count, 1);
    EXPECT_TRUE(for_each_in_parallel(0, "nothing", nullptr, [](int) -> Status { return Error{"never"}; }).ok());
}

TEST(ForEachInParallel, ReturnsAFailureAndBeginsNoFurtherWork) {
    std::atomic<int> begun = 0;
    const Status status = for_each_in_parallel(100000, "work", nullptr, [&](int i) -> Status {
        ++begun;
        return Error{"piece " + std::to_string(i)};
    });
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().message.rfind("piece ", 0), 0U);
    EXPECT_LT(begun, 1000);
}

}  // namespace
}  // namespace rs
