#include "rayspace/base/parallel.hpp"

#include <tbb/parallel_for.h>

#include <atomic>
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

}  // namespace rs
