#include "capture/photos/intake/bounded_work.hpp"

#include "capture/photos/segmentation/segment_turn.hpp"

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

// Largest number of photos in progress at a time, where each starts nested tasks and waits until `expected` are in
// progress.
int measure_max_in_progress(const PhotoFolder& folder, int bytes_per_px, int threads, int expected) {
    using namespace std::chrono_literals;
    const tbb::global_control workers(tbb::global_control::max_allowed_parallelism, 4);  // independent of the machine
    const auto deadline = std::chrono::steady_clock::now() + 20s;
    std::atomic<int> in_progress = 0;
    std::atomic<int> most = 0;
    tbb::task_arena arena(threads);
    const Status status = arena.execute([&] {
        return for_each_photo(folder, bytes_per_px, "", nullptr, [&](std::size_t) -> Status {
            const int now = ++in_progress;
            for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
            }
            while (most < expected && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
            tbb::parallel_for(0, 8, [](int) { std::this_thread::sleep_for(std::chrono::microseconds(300)); });
            --in_progress;
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

int max_in_parallel(int width, int height, int bytes_per_px, int threads) {
    return max_photos_in_parallel(folder_of(width, height, width, height), bytes_per_px, threads);
}

TEST(BoundedWork, LimitsTheNumberOfPhotosByMemory) {
    EXPECT_EQ(max_in_parallel(1000, 800, kSegmentBytesPerPixel, 16), 16);
    EXPECT_EQ(max_in_parallel(4000, 3000, kSegmentBytesPerPixel, 16), 2);
    EXPECT_EQ(max_in_parallel(4000, 3000, kSegmentBytesPerPixel, 1), 1);
    EXPECT_EQ(max_in_parallel(16384, 16384, kSegmentBytesPerPixel, 16), 1) << "at least one";
    // 2^12 * 2^12 px * 2^6 bytes: four of them are exactly the limit.
    EXPECT_EQ(max_in_parallel(4096, 4096, 64, 16), 4);
    EXPECT_EQ(max_in_parallel(4096, 4096, 65, 16), 3);
}

TEST(BoundedWork, CountsTheMemoryForReading) {
    // 2^13 * 2^13 px * 24 bytes: 1.5 GB each, whatever the working size.
    EXPECT_EQ(max_photos_in_parallel(folder_of(1024, 1024, 8192, 8192), 64, 16), 2);
    EXPECT_EQ(max_photos_in_parallel(folder_of(1024, 1024, 2048, 2048), 64, 16), 16);
}

TEST(BoundedWork, RunsAtMostThatManyInParallel) {
    PhotoFolder folder;
    folder.photos.resize(24);
    folder.width = folder.height = 4096;
    EXPECT_EQ(measure_max_in_progress(folder, 256, 4, 1), 1);
    EXPECT_EQ(measure_max_in_progress(folder, 128, 4, 2), 2);
    EXPECT_EQ(measure_max_in_progress(folder, 1, 3, 3), 3);
}

}  // namespace
}  // namespace rs::capture
