#include "compositor/farm/schedule/schedule.hpp"

#include <gtest/gtest.h>

#include <string>

namespace rs::farm {
namespace {

Item item_of(double size, std::int64_t memory_bytes, std::vector<std::size_t> after = {}) {
    return {.name = "of " + std::to_string(size),
            .size = size,
            .memory_bytes = memory_bytes,
            .after = std::move(after),
            .order = {}};
}

TEST(FarmSchedule, TheLargestComesFirstAndOfEqualOnesTheFirst) {
    Schedule schedule({item_of(2, 0), item_of(7, 0), item_of(7, 0), item_of(5, 0)});
    for (int worker = 0; worker < 5; ++worker) schedule.add_worker(worker, "node", 100);
    EXPECT_EQ(schedule.next(0), 1U);
    EXPECT_EQ(schedule.next(1), 2U);
    EXPECT_EQ(schedule.next(2), 3U);
    EXPECT_EQ(schedule.next(3), 0U);
    EXPECT_EQ(schedule.next(4), std::nullopt);
    EXPECT_FALSE(schedule.done());
    for (std::size_t item = 0; item < 4; ++item) EXPECT_TRUE(schedule.settle(item, true).empty());
    EXPECT_TRUE(schedule.done());
}

TEST(FarmSchedule, ItemsWaitForMemoryOfTheirNode) {
    Schedule schedule({item_of(9, 60), item_of(8, 60), item_of(1, 40)});
    schedule.add_worker(0, "one", 100);
    schedule.add_worker(1, "one", 100);
    schedule.add_worker(2, "one", 100);
    schedule.add_worker(3, "other", 100);
    EXPECT_EQ(schedule.next(0), 0U);
    EXPECT_EQ(schedule.next(1), 2U) << "the next smaller that fits beside it, to the last byte";
    EXPECT_EQ(schedule.next(2), std::nullopt);
    EXPECT_EQ(schedule.next(3), 1U) << "another node has memory of its own";
    schedule.finish(0);
    EXPECT_EQ(schedule.next(0), std::nullopt);
}

TEST(FarmSchedule, AnItemLargerThanTheBudgetHasTheNodeToItself) {
    Schedule schedule({item_of(9, 500), item_of(1, 1)});
    schedule.add_worker(0, "node", 100);
    schedule.add_worker(1, "node", 100);
    EXPECT_EQ(schedule.next(0), 0U);
    EXPECT_EQ(schedule.next(1), std::nullopt);
    schedule.finish(0);
    EXPECT_EQ(schedule.next(1), 1U);
}

TEST(FarmSchedule, WhatWasPassedOverManyTimesIsWaitedFor) {
    std::vector<Item> items{item_of(1000, 1), item_of(900, 100)};
    for (int i = 0; i < 100; ++i) items.push_back(item_of(1, 1));
    Schedule schedule(std::move(items));
    schedule.add_worker(0, "node", 100);
    schedule.add_worker(1, "node", 100);
    ASSERT_EQ(schedule.next(0), 0U);  // and goes on for long
    int passed = 0;
    while (const auto item = schedule.next(1)) {
        ASSERT_NE(*item, 1U);
        schedule.finish(1);
        ++passed;
    }
    EXPECT_EQ(passed, kMostPassedOver);
    schedule.finish(0);
    EXPECT_EQ(schedule.next(1), 1U);
}

TEST(FarmSchedule, WhatComesAfterWaitsUntilAllBeforeIsMade) {
    Schedule schedule({item_of(1, 0), item_of(1, 0), item_of(100, 0, {0, 1})});
    schedule.add_worker(0, "node", 1);
    ASSERT_EQ(schedule.next(0), 0U);
    schedule.finish(0);
    schedule.settle(0, true);
    ASSERT_EQ(schedule.next(0), 1U);
    schedule.finish(0);
    EXPECT_EQ(schedule.next(0), std::nullopt) << "its result is not there yet";
    schedule.settle(1, true);
    EXPECT_EQ(schedule.next(0), 2U);
}

TEST(FarmSchedule, WhatComesAfterAFailureIsLostOnce) {
    Schedule schedule({item_of(1, 0), item_of(1, 0), item_of(1, 0, {0, 1}), item_of(1, 0, {2})});
    schedule.add_worker(0, "node", 1);
    ASSERT_EQ(schedule.next(0), 0U);
    schedule.finish(0);
    EXPECT_EQ(schedule.settle(0, false), (std::vector<std::size_t>{2, 3}));
    EXPECT_EQ(schedule.settled(), 3U);
    EXPECT_EQ(schedule.next(0), 1U) << "which goes on";
    schedule.finish(0);
    EXPECT_TRUE(schedule.settle(1, true).empty());
    EXPECT_TRUE(schedule.done());
    EXPECT_EQ(schedule.next(0), std::nullopt);
}

}  // namespace
}  // namespace rs::farm
