#include "capture/photos/intake/bounded_work.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/parallel.hpp"

#include <tbb/task_arena.h>

#include <algorithm>

namespace rs::capture {

int max_photos_in_parallel(const PhotoFolder& folder, int bytes_per_px, int threads) {
    RS_CHECK(folder.width > 0 && folder.height > 0 && bytes_per_px > 0 && threads > 0);
    // The memory for reading is released before `work` allocates its own.
    const std::int64_t read_bytes = std::int64_t{folder.shown_width} * folder.shown_height * kReadBytesPerPixel;
    const std::int64_t photo_bytes = std::max(std::int64_t{folder.width} * folder.height * bytes_per_px, read_bytes);
    return static_cast<int>(std::clamp<std::int64_t>(kWorkingMemory_bytes / photo_bytes, 1, threads));
}

Status for_each_photo(const PhotoFolder& folder, int bytes_per_px, const std::string& label, Progress* progress,
                      const std::function<Status(std::size_t)>& work) {
    tbb::task_arena arena(max_photos_in_parallel(folder, bytes_per_px, tbb::this_task_arena::max_concurrency()));
    return arena.execute([&] {
        return for_each_in_parallel(static_cast<int>(folder.photos.size()), label, progress, [&](int i) {
            // Without isolation a thread that waits inside `work` could start the next photo and hold the memory of
            // two.
            return tbb::this_task_arena::isolate([&] { return work(static_cast<std::size_t>(i)); });
        });
    });
}

}  // namespace rs::capture
