#include "rayspace/format/object_memory.hpp"

#include "rayspace/format/chunk_table.hpp"

namespace rs {

std::int64_t object_memory_bytes(const RaySpaceObject& object) {
    std::int64_t bytes = sizeof(RaySpaceObject);
    for (const object_chunks::ChunkKind& kind : object_chunks::chunk_table()) {
        if (kind.heap_bytes == nullptr) continue;
        for (std::uint32_t index = 0; index < max_chunk_count(kind.each, object); ++index)
            bytes += kind.heap_bytes(object, index);
    }
    return bytes;
}

}  // namespace rs
