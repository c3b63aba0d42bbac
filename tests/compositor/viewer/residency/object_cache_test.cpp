// ObjectCache: budget, order, hysteresis, failures.

#include "compositor/viewer/residency/object_cache.hpp"

#include "tests/compositor/slow_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace rs::compositor {
namespace {

using test::SlowSource;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::filesystem::path> files(int count) {
    std::vector<std::filesystem::path> names;
    for (int i = 0; i < count; ++i) names.emplace_back(std::string(1, static_cast<char>('a' + i)));
    return names;
}

// Memory of `objects` objects in addition to the one being read.
std::int64_t room_for(int objects) {
    return objects * SlowSource::object_bytes() + SlowSource::reading_bytes();
}

// A cache with a user of its objects.
class StoreVisitor {
public:
    StoreVisitor(int count, std::int64_t budget_bytes, test::SlowSourceOptions options = {})
        : log(std::make_shared<test::SourceLog>()),
          budget_(budget_bytes),
          store(files(count), std::make_unique<SlowSource>(log, std::move(options)), budget_bytes) {}

    void listen() {
        for (CacheEvent& event : store.events()) {
            if (event.kind == CacheEvent::Kind::kLoaded) {
                EXPECT_FALSE(here.contains(event.file)) << "arrived twice";
                here[event.file] = event.object;
            } else if (event.kind == CacheEvent::Kind::kEvicting) {
                EXPECT_TRUE(here.contains(event.file)) << "leaves without having come";
                here.erase(event.file);
                ++left;
                store.give_back(std::move(event.object));
            } else {
                failures.push_back(event.why);
            }
        }
        check_budget();
    }

    void settle() {
        while (!store.settled()) {
            store.wait_for_events();
            listen();
        }
    }

    void check_budget() const {
        const CacheStatistics statistics = store.statistics();
        EXPECT_LE(statistics.used_bytes, budget_);
        EXPECT_LE(statistics.peak_bytes, budget_);
        const std::lock_guard lock(log->mutex);
        EXPECT_LE(log->most_alive_bytes, budget_);
    }

    [[nodiscard]] std::vector<std::size_t> held() const {
        std::vector<std::size_t> numbers;
        for (const auto& [number, object] : here) numbers.push_back(number);
        return numbers;
    }

    std::shared_ptr<test::SourceLog> log;

private:
    std::int64_t budget_;

public:
    std::map<std::size_t, std::shared_ptr<const ViewableObject>> here;
    std::vector<std::string> failures;
    int left = 0;
    ObjectCache store;
};

std::vector<LoadPriority> distances(const std::vector<double>& rooms) {
    std::vector<LoadPriority> priorities;
    for (const double room : rooms) priorities.push_back({room, 1, 0.5});
    return priorities;
}

TEST(ObjectCache, ReadsTheMostWantedFirstAndEachOnce) {
    StoreVisitor visitor(5, room_for(5));
    visitor.store.set_priorities(
        {{4, 1}, {LoadPriority::kHere, 7}, {2, 9}, {LoadPriority::kHere, 3}, {LoadPriority::kAlways, 50}});
    visitor.settle();
    EXPECT_THAT(visitor.log->names(), ElementsAre("e", "d", "b", "c", "a"));
    EXPECT_EQ(visitor.store.statistics().loads, 5);
    EXPECT_GT(visitor.store.load_seconds(0), 0);
    visitor.store.set_priorities(
        {{4, 2}, {LoadPriority::kHere, 7}, {2, 9}, {LoadPriority::kHere, 3}, {LoadPriority::kAlways, 50}});
    visitor.settle();
    EXPECT_EQ(visitor.store.statistics().loads, 5);
}

TEST(ObjectCache, NothingIsReadBeforeItIsWanted) {
    // A single reader thread gives a deterministic order: an early read would come first.
    for (int trial = 0; trial < 50; ++trial) {
        StoreVisitor visitor(3, room_for(1));
        visitor.store.set_priorities(distances({9, 8, 0}));
        visitor.settle();
        ASSERT_FALSE(visitor.log->names().empty());
        ASSERT_EQ(visitor.log->names().front(), "c");
    }
}

TEST(ObjectCache, TheFarthestMakesRoom) {
    StoreVisitor visitor(4, room_for(2));
    visitor.store.set_priorities(distances({0, 4, 8, 12}));
    visitor.settle();
    EXPECT_THAT(visitor.held(), ElementsAre(0, 1, 2)) << "the third fits once reading is over";
    visitor.store.set_priorities(distances({12, 8, 4, 0}));
    visitor.settle();
    EXPECT_THAT(visitor.held(), ElementsAre(1, 2, 3));
    EXPECT_EQ(visitor.store.statistics().evictions, 1);
}

TEST(ObjectCache, NearlyAsFarMakesNoRoom) {
    StoreVisitor visitor(3, room_for(0));  // one
    visitor.store.set_priorities(distances({5, 5.2, 5.1}));
    visitor.settle();
    EXPECT_THAT(visitor.held(), ElementsAre(0));
    for (int n = 0; n < 20; ++n) {
        const double aside = n % 2 == 0 ? 0.4 : -0.4;
        visitor.store.set_priorities(distances({5 + aside, 5 - aside, 5.1}));
        visitor.settle();
    }
    EXPECT_EQ(visitor.store.statistics().evictions, 0);
    visitor.store.set_priorities(distances({7, 5, 5.1}));
    visitor.settle();
    EXPECT_THAT(visitor.held(), ElementsAre(1));
}

TEST(ObjectCache, TheBudgetHoldsWhateverIsWanted) {
    constexpr int kFiles = 14;
    test::SlowSourceOptions options;
    options.reading = std::chrono::microseconds(200);
    options.times_larger = {{"c", 2}, {"f", 3}, {"g", 2}};
    StoreVisitor visitor(kFiles, room_for(5), options);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> distance(0, 20);
    for (int n = 0; n < 120; ++n) {
        std::vector<LoadPriority> priorities;
        for (int i = 0; i < kFiles; ++i) {
            const double room = std::floor(distance(random));
            priorities.push_back({room < 2 ? LoadPriority::kHere : room, distance(random), 0.5});
        }
        visitor.store.set_priorities(std::move(priorities));
        for (int m = 0; m < n % 7; ++m) {
            std::this_thread::sleep_for(std::chrono::microseconds(300));
            visitor.listen();
        }
        if (n % 10 == 9) visitor.settle();
    }
    visitor.settle();
    visitor.check_budget();
    EXPECT_GT(visitor.left, 20);
    EXPECT_GE(visitor.store.statistics().evictions, visitor.left) << "some leave before they are seen";
    EXPECT_GE(visitor.held().size(), 4U);
    const std::lock_guard lock(visitor.log->mutex);
    EXPECT_GT(visitor.log->most_alive_bytes, 5 * SlowSource::object_bytes()) << "it is used, too";
}

TEST(ObjectCache, MemoryIsFreeOnlyWhenNobodyUsesTheObject) {
    StoreVisitor visitor(2, room_for(0));
    visitor.store.set_priorities(distances({1, 20}));
    visitor.settle();
    const std::shared_ptr<const ViewableObject> still_used = visitor.here.at(0);
    visitor.store.set_priorities(distances({20, 1}));
    for (int n = 0; n < 10; ++n) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        visitor.listen();
    }
    EXPECT_THAT(visitor.held(), IsEmpty());
    EXPECT_EQ(visitor.store.statistics().used_bytes, still_used->memory_bytes());
}

TEST(ObjectCache, FailuresAreToldOnceAndTheRestGoesOn) {
    test::SlowSourceOptions options;
    options.broken = {"b"};
    options.gone = {"a"};
    options.times_larger = {{"d", 50}};
    StoreVisitor visitor(5, room_for(5), options);
    visitor.store.set_priorities(distances({1, 2, 3, 4, 5}));
    visitor.settle();
    EXPECT_THAT(visitor.held(), ElementsAre(2, 4));
    EXPECT_THAT(visitor.failures, ElementsAre(HasSubstr("a: is not there"), HasSubstr("more than the budget"),
                                              HasSubstr("b: is broken")));
    visitor.store.set_priorities(distances({5, 4, 3, 2, 1}));
    visitor.settle();
    EXPECT_EQ(visitor.failures.size(), 3U);
    EXPECT_EQ(visitor.store.statistics().failures, 3);
}

TEST(ObjectCache, MayBeDestroyedWhileItReads) {
    for (int n = 0; n < 20; ++n) {
        test::SlowSourceOptions options;
        options.reading = std::chrono::milliseconds(3);
        StoreVisitor visitor(4, room_for(1), options);
        visitor.store.set_priorities(distances({1, 2, 3, 4}));
        std::this_thread::sleep_for(std::chrono::milliseconds(n));
        if (n % 2 == 0) visitor.listen();
    }
}

TEST(ObjectCache, ObjectsOutliveIt) {
    std::shared_ptr<const ViewableObject> kept;
    auto log = std::make_shared<test::SourceLog>();
    {
        StoreVisitor visitor(1, room_for(1));
        visitor.store.set_priorities(distances({1}));
        visitor.settle();
        kept = visitor.here.at(0);
        log = visitor.log;
    }
    EXPECT_EQ(log->alive_bytes, SlowSource::object_bytes());
    EXPECT_FALSE(kept->bounds.empty());
    kept.reset();
    EXPECT_EQ(log->alive_bytes, 0);
}

TEST(MemoryBudget, GivesNoMoreThanItHas) {
    MemoryBudget memory(100);
    auto first = memory.reserve(60);
    ASSERT_TRUE(first);
    EXPECT_FALSE(memory.reserve(41));
    auto second = memory.reserve(40);
    ASSERT_TRUE(second);
    first->shrink(10);
    EXPECT_EQ(memory.used_bytes(), 50);
    second.reset();
    EXPECT_EQ(memory.used_bytes(), 10);
    EXPECT_EQ(memory.peak_bytes(), 100);
    MemoryLease moved = std::move(*first);
    first.reset();
    EXPECT_EQ(memory.used_bytes(), 10);
    moved = MemoryLease();
    EXPECT_EQ(memory.used_bytes(), 0);
}

TEST(LoadPriority, GivesWayOnlyWhereItIsClearlyLessWanted) {
    const LoadPriority here{LoadPriority::kHere, 2, 0.3};
    EXPECT_FALSE(is_evictable_for(here, {LoadPriority::kHere, 2.3, 0.3}));
    EXPECT_FALSE(is_evictable_for({0.2, 1, 0.3}, here)) << "at the door of the next room";
    EXPECT_TRUE(is_evictable_for({0.4, 1, 0.3}, here));
    EXPECT_FALSE(is_evictable_for({5, 1, 0.3}, {4, 1, 0.3}));
    EXPECT_TRUE(is_evictable_for({6, 1, 0.3}, {4, 1, 0.3}));
    EXPECT_FALSE(is_evictable_for({4, 1, 0.3}, {6, 1, 0.3}));
    EXPECT_TRUE(is_evictable_for({LoadPriority::kHere, 9, 0.3}, {LoadPriority::kHere, 2, 0.3}));
    EXPECT_FALSE(is_evictable_for({LoadPriority::kAlways, 90, 0.3}, here));
    EXPECT_FALSE(is_evictable_for({6, 1, 0.3, 0.2}, here)) << "just left, in a hurry";
}

}  // namespace
}  // namespace rs::compositor
