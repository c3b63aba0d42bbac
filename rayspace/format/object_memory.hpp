#pragma once
// How much memory ray-space objects take, for whoever keeps to a budget. Pure; thread-safe.

#include "rayspace/base/result.hpp"
#include "rayspace/format/container.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>

namespace rs {

// Of everything that the object holds, coded images included even where they are shared.
std::int64_t memory_of(const RaySpaceObject& object);

// What read_object() of a file will take. Bounds, close ones: nothing of the images is read for them.
struct ReadingMemory {
    std::int64_t most_bytes = 0;    // at a time
    std::int64_t object_bytes = 0;  // of the object, when it is read: at least memory_of() it
    int width = 0;                  // of its images, px
    int height = 0;
    std::int64_t images = 0;
};
// Reads what is small, and the heads of shape maps. Fails as read_object() would for the same reasons.
Result<ReadingMemory> memory_to_read(const ContainerReader& container, const ReadObjectOptions& options = {});

}  // namespace rs
