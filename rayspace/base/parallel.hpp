#pragma once
// The same work on many things at once.

#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace rs {

// Calls work(0) .. work(count - 1) on the threads of the calling tbb arena, in any order, and advances `progress` (may
// be null) under `label`. After a failure no further call is begun; of the failures that happened the one with the
// lowest index is returned.
Status for_each_in_parallel(int count, const std::string& label, Progress* progress,
                            const std::function<Status(int)>& work);

// Calls work(0) .. work(count - 1), in any order, on `threads` threads (0 = as many as the processor has).
void for_each_index(std::int64_t count, int threads, const std::function<void(std::int64_t)>& work);

}  // namespace rs
