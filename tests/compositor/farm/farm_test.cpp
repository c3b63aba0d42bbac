// Coordinator and workers, as threads.

#include "compositor/farm/schedule/coordinator.hpp"
#include "compositor/farm/schedule/worker.hpp"
#include "compositor/farm/work/timed_job.hpp"
#include "tests/compositor/farm/thread_transport.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <functional>
#include <mutex>
#include <thread>

namespace rs::farm {
namespace {

class InstantJob final : public Job {
public:
    explicit InstantJob(Outcome outcome) : outcome_(std::move(outcome)) {}
    std::optional<Outcome> poll() override { return outcome_; }

private:
    Outcome outcome_;
};

std::vector<Item> counted_items(int count) {
    std::vector<Item> items;
    for (int i = 0; i < count; ++i) {
        items.push_back({.name = std::to_string(i), .size = 1.0 + i, .memory_bytes = 1, .after = {}, .order = i});
    }
    return items;
}

// Runs a farm of `ranks` threads to its end. `meanwhile` is called again and again where the coordinator is.
Standing run(int ranks, std::vector<Item> items, Manifest& manifest, const BeginJob& begin,
             const std::function<void(Coordinator&)>& meanwhile = {}) {
    test::ThreadRanks all(ranks);
    std::vector<std::thread> others;
    for (int rank = 1; rank < ranks; ++rank) {
        others.emplace_back([&, rank] {
            test::ThreadRanks::Rank transport(all, rank);
            Worker worker(transport, {"node", 1000}, begin);
            while (!worker.ended()) {
                if (!worker.step()) std::this_thread::yield();
            }
        });
    }
    test::ThreadRanks::Rank transport(all, 0);
    Worker worker(transport, {"node", 1000}, begin);
    Coordinator coordinator(transport, std::move(items), manifest, std::nullopt);
    while (!worker.ended() || !coordinator.ended()) {
        const bool worked = worker.step();
        const bool managed = coordinator.step();
        if (meanwhile) meanwhile(coordinator);
        if (!worked && !managed) std::this_thread::yield();
    }
    for (std::thread& other : others) other.join();
    EXPECT_FALSE(coordinator.failure()) << coordinator.failure()->message;
    return coordinator.standing();
}

TEST(Farm, EveryItemIsDoneOnceByHoweverManyRanks) {
    for (const int ranks : {1, 2, 5}) {
        const rs::test::TemporaryFolder folder;
        Result<Manifest> manifest = Manifest::open(folder / "m", 0);
        ASSERT_TRUE(manifest.ok());
        std::mutex mutex;
        std::vector<int> begun(200);
        const Standing standing = run(ranks, counted_items(200), *manifest, [&](const auto& order, const Outcome*) {
            const std::lock_guard lock(mutex);
            ++begun.at(order.template get<std::size_t>());
            return std::make_unique<InstantJob>(Outcome{.state = State::kMade, .key = order.dump()});
        });
        EXPECT_EQ(begun, std::vector<int>(200, 1)) << ranks;
        EXPECT_EQ(standing.count(State::kMade), 200);
        EXPECT_EQ(standing.size_done, standing.size_all);
        for (int i = 0; i < 200; ++i)
            EXPECT_EQ(standing.outcomes.at(static_cast<std::size_t>(i)).key, std::to_string(i));
    }
}

TEST(Farm, WhatTheManifestSaysReachesWhoeverGetsTheItem) {
    const rs::test::TemporaryFolder folder;
    const auto begin = [](const auto& order, const Outcome* record) {
        Outcome outcome{.state = State::kMade, .key = "key of " + order.dump()};
        if (record != nullptr && record->key == outcome.key) outcome.state = State::kKept;
        return std::make_unique<InstantJob>(outcome);
    };
    for (const bool again : {false, true}) {
        Result<Manifest> manifest = Manifest::open(folder / "m", 0);
        ASSERT_TRUE(manifest.ok());
        const Standing standing = run(3, counted_items(20), *manifest, begin);
        EXPECT_EQ(standing.count(again ? State::kKept : State::kMade), 20);
    }
    std::ifstream lines(folder / "m");
    EXPECT_EQ(std::count(std::istreambuf_iterator<char>(lines), {}, '\n'), 20) << "what is kept is not written again";
}

TEST(Farm, BadItemsDoNotStopOthers) {
    const rs::test::TemporaryFolder folder;
    Result<Manifest> manifest = Manifest::open(folder / "m", 0);
    ASSERT_TRUE(manifest.ok());
    std::vector<Item> items = counted_items(30);
    items.push_back({.name = "after", .size = 1, .memory_bytes = 0, .after = {7}, .order = 30});
    const Standing standing =
        run(3, std::move(items), *manifest, [](const auto& order, const Outcome*) -> std::unique_ptr<Job> {
            if (order == 3) throw std::runtime_error("thrown");
            if (order == 7) return std::make_unique<InstantJob>(Outcome{.why = "bad"});
            return std::make_unique<InstantJob>(Outcome{.state = State::kMade});
        });
    EXPECT_EQ(standing.count(State::kMade), 28);
    EXPECT_EQ(standing.count(State::kFailed), 3);
    EXPECT_EQ(standing.outcomes[3].why, "thrown");
    EXPECT_EQ(standing.outcomes[7].why, "bad");
    EXPECT_EQ(standing.outcomes[30].why, "was not begun, for 7 failed");
}

TEST(Farm, AResultIsPutInPlaceBeforeWhatComesAfterItBegins) {
    const rs::test::TemporaryFolder folder;
    Result<Manifest> manifest = Manifest::open(folder / "m", 0);
    ASSERT_TRUE(manifest.ok());
    std::vector<Item> items = counted_items(1);
    items.push_back({.name = "after", .size = 1, .memory_bytes = 0, .after = {0}, .order = 1});
    std::atomic<bool> was_there{false};
    run(2, std::move(items), *manifest, [&](const auto& order, const Outcome*) {
        Outcome outcome{.state = State::kMade};
        if (order == 0) {
            std::ofstream(folder / "staged") << "whole";
            outcome.staged = (folder / "staged").string();
            outcome.output = (folder / "result").string();
        } else {
            was_there = std::filesystem::exists(folder / "result");
        }
        return std::make_unique<InstantJob>(outcome);
    });
    EXPECT_TRUE(was_there);
    EXPECT_FALSE(std::filesystem::exists(folder / "staged"));
}

TEST(Farm, AnInterruptedRunStopsAtOnceAndTheNextDoesTheRest) {
    const rs::test::TemporaryFolder folder;
    constexpr int kItems = 12;
    std::atomic<int> begun{0};
    const auto begin = [&](const nlohmann::json& order, const Outcome* record) -> std::unique_ptr<Job> {
        if (record != nullptr) return std::make_unique<InstantJob>(Outcome{.state = State::kKept});
        ++begun;
        // The last to be begun would take for ever.
        if (order == 0 && begun <= kItems) return begin_timed_jobs()({{"seconds", 1e6}}, nullptr);
        return std::make_unique<InstantJob>(Outcome{.state = State::kMade});
    };
    {
        Result<Manifest> manifest = Manifest::open(folder / "m", 0);
        ASSERT_TRUE(manifest.ok());
        const Standing standing = run(2, counted_items(kItems), *manifest, begin, [](Coordinator& coordinator) {
            if (coordinator.standing().count(State::kMade) == kItems - 1) coordinator.interrupt();
        });
        EXPECT_TRUE(standing.interrupted);
        EXPECT_EQ(standing.count(State::kMade), kItems - 1);
    }
    Result<Manifest> manifest = Manifest::open(folder / "m", 0);
    ASSERT_TRUE(manifest.ok());
    const Standing standing = run(2, counted_items(kItems), *manifest, begin);
    EXPECT_EQ(standing.count(State::kKept), kItems - 1);
    EXPECT_EQ(standing.count(State::kMade), 1);
}

}  // namespace
}  // namespace rs::farm
