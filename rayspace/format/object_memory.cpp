#include "rayspace/format/object_memory.hpp"

#include "rayspace/format/chunk_table.hpp"

namespace rs {

std::int64_t memory_of(const RaySpaceObject& object) {
    std::int64_t bytes = sizeof(RaySpaceObject);
    for (const object_chunks::ChunkKind& kind : object_chunks::chunk_table()) {
        if (kind.held_bytes == nullptr) continue;
        for (std::uint32_t index = 0; index < count_of(kind.each, object); ++index)
            bytes += kind.held_bytes(object, index);
    }
    return bytes;
}

}  // namespace rs
