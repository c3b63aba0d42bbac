#pragma once
// Many small pieces of work on a limited number of threads.

#include <cstdint>
#include <functional>

namespace rs::capture {

// Calls work(0) .. work(count - 1), in any order, on `threads` threads (0 = as many as the processor has).
void for_each_index(std::int64_t count, int threads, const std::function<void(std::int64_t)>& work);

}  // namespace rs::capture
