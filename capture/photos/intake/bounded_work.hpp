#pragma once
// Work on the photographs of a turn side by side: on all cores as long as the memory for that is there, on fewer of
// them where the photographs are large.

#include "capture/photos/intake/photo_folder.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace rs::capture {

// What all photographs in work may take together.
inline constexpr std::int64_t kWorkingMemory_bytes = std::int64_t{4} << 30;

// What reading a picture takes at most, per pixel: its file's samples as floats and the picture.
inline constexpr int kReadBytesPerPixel = 24;

// How many of the folder's photographs are worked on at a time where each takes `bytes_per_px` of the size it is worked
// on in, or kReadBytesPerPixel of the size it is read in: as many as kWorkingMemory_bytes holds, at least one, at most
// `threads`.
int photos_at_a_time(const PhotoFolder& folder, int bytes_per_px, int threads);

// for_each_in_parallel() (rayspace/base/parallel.hpp) over the folder's photographs, photos_at_a_time() of them, with
// no more threads than the calling tbb arena has. Work that waits for tasks of its own begins no other photograph.
Status for_each_photo(const PhotoFolder& folder, int bytes_per_px, const std::string& label, Progress* progress,
                      const std::function<Status(std::size_t)>& work);

}  // namespace rs::capture
