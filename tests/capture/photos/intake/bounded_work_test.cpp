#include "capture/photos/intake/bounded_work.hpp"

#include "capture/photos/matte/cut_turn.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace rs::capture {
namespace {

// The most photographs of `folder` that were in work at a time, each of which splits into tasks of its own. They wait
// for one another until `expected` of them are.
int most_at_a_time(const PhotoFolder& folder, int bytes_per_px, int threads, int expected) {
    using namespace std::chrono_literals;
    const tbb::global_control workers(tbb::global_control::max_allowed_parallelism, 4);  // whatever the machine has
    const auto patience = std::chrono::steady_clock::now() + 20s;
    std::atomic<int> in_work = 0;
    std::atomic<int> most = 0;
    tbb::task_arena arena(threads);
    const Status status = arena.execute([&] {
        return for_each_photo(folder, bytes_per_px, "", nullptr, [&](std::size_t) -> Status {
            const int now = ++in_work;
            for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
            }
            while (most < expected && std::chrono::steady_clock::now() < patience) std::this_thread::yield();
            tbb::parallel_for(0, 8, [](int) { std::this_thread::sleep_for(std::chrono::microseconds(300)); });
            --in_work;
            return {};
        });
    });
    EXPECT_TRUE(status.ok());
    return most;
}

PhotoFolder folder_of(int width, int height, int shown_width, int shown_height) {
    PhotoFolder folder;
    folder.width = width;
    folder.height = height;
    folder.shown_width = shown_width;
    folder.shown_height = shown_height;
    return folder;
}

int at_a_time(int width, int height, int bytes_per_px, int threads) {
    return photos_at_a_time(folder_of(width, height, width, height), bytes_per_px, threads);
}

TEST(BoundedWork, TakesAsManyPhotographsAsTheMemoryHolds) {
    EXPECT_EQ(at_a_time(1000, 800, kCutBytesPerPixel, 16), 16);
    EXPECT_EQ(at_a_time(4000, 3000, kCutBytesPerPixel, 16), 2);
    EXPECT_EQ(at_a_time(4000, 3000, kCutBytesPerPixel, 1), 1);
    EXPECT_EQ(at_a_time(16384, 16384, kCutBytesPerPixel, 16), 1) << "never none";
    // 2^12 * 2^12 px * 2^6 bytes: four of them are the budget to the byte.
    EXPECT_EQ(at_a_time(4096, 4096, 64, 16), 4);
    EXPECT_EQ(at_a_time(4096, 4096, 65, 16), 3);
}

TEST(BoundedWork, CountsWhatReadingALargePhotographTakes) {
    // 2^13 * 2^13 px * 24 bytes: 1.5 GB each, whatever the size that is worked with.
    EXPECT_EQ(photos_at_a_time(folder_of(1024, 1024, 8192, 8192), 64, 16), 2);
    EXPECT_EQ(photos_at_a_time(folder_of(1024, 1024, 2048, 2048), 64, 16), 16);
}

TEST(BoundedWork, KeepsToTheBound) {
    PhotoFolder folder;
    folder.photos.resize(24);
    folder.width = folder.height = 4096;
    EXPECT_EQ(most_at_a_time(folder, 256, 4, 1), 1);
    EXPECT_EQ(most_at_a_time(folder, 128, 4, 2), 2);
    EXPECT_EQ(most_at_a_time(folder, 1, 3, 3), 3);
}

}  // namespace
}  // namespace rs::capture
