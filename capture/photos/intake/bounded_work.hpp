#pragma once
/// \file
/// Parallel loop over the photos of a turn with bounded memory: fewer threads for large photos.

#include "capture/photos/intake/photo_folder.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace rs::capture {

/// Memory limit of all photos in progress.
inline constexpr std::int64_t kWorkingMemory_bytes = std::int64_t{4} << 30;

/// Peak memory of reading a photo, bytes per pixel: the file's samples as floats, and the image.
inline constexpr int kReadBytesPerPixel = 24;

/// Number of photos that may be in progress at a time, 1..threads: as many as kWorkingMemory_bytes allows, where each
/// takes `bytes_per_px` in its working size or kReadBytesPerPixel in its full size, whichever is more.
int max_photos_in_parallel(const PhotoFolder& folder, int bytes_per_px, int threads);

/// for_each_in_parallel() (rayspace/base/parallel.hpp) over the indices of folder.photos, max_photos_in_parallel() at a
/// time, with at most the threads of the calling TBB arena. A thread that waits for nested tasks does not start another
/// photo.
/// \param label shown by `progress`. Errors: the first error of `work`.
Status for_each_photo(const PhotoFolder& folder, int bytes_per_px, const std::string& label, Progress* progress,
                      const std::function<Status(std::size_t)>& work);

}  // namespace rs::capture
