#pragma once
// Parallel loops with errors, progress, or a thread count.

#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace rs {

/// Calls work(0) .. work(count - 1) on the threads of the calling tbb arena, in any order, and advances `progress` (may
/// be null) under `label`. After a failure no further call starts.
/// \return the error with the lowest index among those that occurred.
Status for_each_in_parallel(int count, const std::string& label, Progress* progress,
                            const std::function<Status(int)>& work);

/// Calls work(0) .. work(count - 1), in any order, on `threads` threads (0: one per processor).
void for_each_index(std::int64_t count, int threads, const std::function<void(std::int64_t)>& work);

}  // namespace rs
