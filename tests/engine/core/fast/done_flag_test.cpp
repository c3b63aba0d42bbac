#include "engine/core/fast/done_flag.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace rs::engine {
namespace {

TEST(DoneFlag, WorkIsDoneOnce) {
    DoneFlag flag;
    std::atomic<int> calls = 0;
    std::vector<std::thread> threads;
    for (int i = 0; i < 8; ++i) threads.emplace_back([&] { flag.ensure([&] { ++calls; }); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(calls, 1);
    EXPECT_TRUE(flag.done());
    flag.reset();
    EXPECT_FALSE(flag.done());
}

TEST(DoneFlag, AWaitingThreadRetriesIfWorkThrows) {
    for (int trial = 0; trial < 50; ++trial) {
        DoneFlag flag;
        std::atomic<int> calls = 0, thrown = 0;
        constexpr int kThreads = 6, kFailures = 3;
        std::vector<std::thread> threads;
        for (int i = 0; i < kThreads; ++i) {
            threads.emplace_back([&] {
                try {
                    flag.ensure([&] {
                        if (++calls <= kFailures) throw std::runtime_error("no memory");
                    });
                } catch (const std::runtime_error&) {
                    ++thrown;
                }
            });
        }
        for (std::thread& thread : threads) thread.join();  // would not return if the flag stayed busy
        EXPECT_TRUE(flag.done());
        EXPECT_EQ(calls, kFailures + 1);
        EXPECT_EQ(thrown, kFailures);
    }
}

}  // namespace
}  // namespace rs::engine
