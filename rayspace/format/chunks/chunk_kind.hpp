#pragma once
// Chunk kinds: rows of chunk_table.cpp. Each file of this folder provides the row of one kind; payloads are specified
// in encode/FORMAT.md, section "Chunks". Errors do not name the file, chunk, ring or view; the caller adds these
// (except for VIEW, which contains all views).

#include "rayspace/base/result.hpp"
#include "rayspace/format/object_chunks.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rs::object_chunks {

using Bytes = std::span<const std::byte>;

/// An object while it is read.
struct PartialObject {
    RaySpaceObject object;
    std::shared_ptr<codec::CodedImages> coded;  // object.coded, while it is filled
};

/// Memory for parsing a chunk beyond a small multiple of its payload.
struct ChunkMemory {
    std::uint64_t kept_bytes = 0;       // kept by the object
    std::uint64_t temporary_bytes = 0;  // freed after parsing
};

/// Stages are read in order. The memory of the first stage is bounded by counts that its parsers check.
enum class ReadStage { geometry, maps, shapes, images };
enum class ChunkScope { object, ring, view };

/// One kind of chunk. The table is in file order: chunks per object, then per ring, then per view by levels. `index` is
/// the number of the ring or view, or 0.
struct ChunkKind {
    ChunkName name{};
    ChunkScope each = ChunkScope::object;
    ReadStage stage = ReadStage::geometry;
    /// True if an object has the chunk; null: every object has it.
    bool (*is_present)(const RaySpaceObject& object, std::uint32_t index) = nullptr;
    Payload (*payload)(const RaySpaceObject& object, std::uint32_t index) = nullptr;
    /// Memory needed, without allocating it; null if no more than the payload.
    Result<ChunkMemory> (*memory)(Bytes payload, PartialObject& partial, std::uint32_t index) = nullptr;
    /// Parses the payload; checks only what it needs to read and allocate safely: sizes, counts and limits.
    Status (*parse)(Bytes payload, PartialObject& partial, std::uint32_t index) = nullptr;
    /// Validates the values of an object whose previous chunks are valid; null: nothing to check.
    Status (*validate)(const RaySpaceObject& object, std::uint32_t index) = nullptr;
    /// Heap memory of the parsed chunk; null: none.
    std::int64_t (*heap_bytes)(const RaySpaceObject& object, std::uint32_t index) = nullptr;
};
inline Error wrong_size(std::uint64_t found, std::uint64_t expected) {
    return Error{"is " + std::to_string(found) + " bytes long instead of " + std::to_string(expected)};
}

template <class T>
std::int64_t heap_bytes_of(const std::vector<T>& list) {
    return static_cast<std::int64_t>(list.capacity() * sizeof(T));
}

/// NAME_chunk() is in chunks/NAME_chunk.cpp.
ChunkKind head_chunk();
ChunkKind rig_chunk();
ChunkKind views_chunk();
ChunkKind foot_chunk();
ChunkKind code_chunk();
ChunkKind ring_chunk();
ChunkKind axis_chunk();
ChunkKind map_chunk();
ChunkKind shape_chunk();
ChunkKind image_chunk();

}  // namespace rs::object_chunks
