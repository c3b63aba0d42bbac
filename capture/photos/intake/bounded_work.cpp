#include "capture/photos/intake/bounded_work.hpp"

#include "rayspace/base/check.hpp"
#include "rayspace/base/parallel.hpp"

#include <tbb/task_arena.h>

#include <algorithm>

namespace rs::capture {

int photos_at_a_time(const PhotoFolder& folder, int bytes_per_px, int threads) {
    RS_CHECK(folder.width > 0 && folder.height > 0 && bytes_per_px > 0 && threads > 0);
    // What a large photograph takes while it is read is given back before the work on it begins.
    const std::int64_t read_bytes = std::int64_t{folder.shown_width} * folder.shown_height * kReadBytesPerPixel;
    const std::int64_t photo_bytes = std::max(std::int64_t{folder.width} * folder.height * bytes_per_px, read_bytes);
    return static_cast<int>(std::clamp<std::int64_t>(kWorkingMemory_bytes / photo_bytes, 1, threads));
}

Status for_each_photo(const PhotoFolder& folder, int bytes_per_px, const std::string& label, Progress* progress,
                      const std::function<Status(std::size_t)>& work) {
    tbb::task_arena arena(photos_at_a_time(folder, bytes_per_px, tbb::this_task_arena::max_concurrency()));
    return arena.execute([&] {
        return for_each_in_parallel(static_cast<int>(folder.photos.size()), label, progress, [&](int i) {
            // Without isolation a thread that waits inside `work` may take up the next photograph meanwhile, and hold
            // the memory of two.
            return tbb::this_task_arena::isolate([&] { return work(static_cast<std::size_t>(i)); });
        });
    });
}

}  // namespace rs::capture
