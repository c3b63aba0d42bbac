#include "rayspace/base/parallel.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cstddef>
#include <mutex>
#include <optional>

namespace rs {

Status for_each_in_parallel(int count, const std::string& label, Progress* progress,
                            const std::function<Status(int)>& work) {
    std::atomic<bool> failed = false;
    std::mutex mutex;
    int first_failed = count;
    Status first_failure;
    if (progress != nullptr) progress->start(label, count);
    tbb::parallel_for(0, count, [&](int i) {
        if (failed) return;
        if (Status status = work(i); !status) {
            failed = true;
            const std::lock_guard lock(mutex);
            if (i < first_failed) {
                first_failed = i;
                first_failure = std::move(status);
            }
            return;
        }
        if (progress != nullptr) progress->advance();
    });
    if (progress != nullptr) progress->finish();
    return first_failure;
}

void for_each_index(std::int64_t count, int threads, const std::function<void(std::int64_t)>& work) {
    if (threads <= 0) threads = tbb::info::default_concurrency();
    const tbb::global_control workers(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<std::int64_t>(0, count, 1),
            [&](const tbb::blocked_range<std::int64_t>& range) {
                for (std::int64_t index = range.begin(); index != range.end(); ++index) work(index);
            },
            tbb::simple_partitioner());
    });
}

}  // namespace rs
