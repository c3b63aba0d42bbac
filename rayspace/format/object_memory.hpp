#pragma once
// Memory of ray-space objects, for callers with a memory budget. Thread-safe.

#include "rayspace/base/result.hpp"
#include "rayspace/format/container.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>

namespace rs {

/// Memory of the whole object, including coded images even if they are shared.
std::int64_t object_memory_bytes(const RaySpaceObject& object);

/// Upper bounds of the memory for read_object(), close to the real values; computed without reading the images.
struct ReadMemory {
    std::int64_t most_bytes = 0;    // peak while reading
    std::int64_t object_bytes = 0;  // the object after reading; at least object_memory_bytes() it
    int width = 0;                  // px, of its images
    int height = 0;
    std::int64_t images = 0;
};
/// Reads the small chunks and the heads of shape maps. Errors as in read_object().
Result<ReadMemory> estimate_read_memory(const ContainerReader& container, const ReadObjectOptions& options = {});

}  // namespace rs
