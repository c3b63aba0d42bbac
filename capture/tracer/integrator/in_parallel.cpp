#include "capture/tracer/integrator/in_parallel.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>

namespace rs::capture {

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

}  // namespace rs::capture
