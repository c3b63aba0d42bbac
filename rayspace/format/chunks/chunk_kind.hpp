#pragma once
// What an .rso file's chunk is: a row of chunk_table.cpp. Each kind has a file of this folder, which gives its row; its
// payload is encode/FORMAT.md's, section "Chunks". Errors name neither file nor chunk, ring or view, the caller does
// (but for VIEW, which holds all views).

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

// An object that is being read.
struct UnreadObject {
    RaySpaceObject object;
    std::shared_ptr<codec::CodedImages> coded;  // object.coded, while it is filled
};

// What parsing a chunk takes beyond a small multiple of its payload.
struct ChunkMemory {
    std::uint64_t kept_bytes = 0;     // by the object
    std::uint64_t passing_bytes = 0;  // while it is parsed
};

// Read one after the other. Everything of the first is bound by counts that its chunks' parsers check.
enum class ReadStage { geometry, maps, images };
enum class OneFor { object, ring, view };

// The table's order is the file's: those of an object, then those of ring after ring, then those of views by levels.
// `index` is the ring's or the view's number, or 0.
struct ChunkKind {
    ChunkName name{};
    OneFor each = OneFor::object;
    ReadStage stage = ReadStage::geometry;
    // Whether an object has it; null: always.
    bool (*is_there)(const RaySpaceObject& object, std::uint32_t index) = nullptr;
    Payload (*payload)(const RaySpaceObject& object, std::uint32_t index) = nullptr;
    // Null where it takes nothing more. Does not yet allocate it.
    Result<ChunkMemory> (*memory)(Bytes payload, UnreadObject& unread, std::uint32_t index) = nullptr;
    // Checks what it needs in order to read and to allocate safely: sizes, counts and caps.
    Status (*parse)(Bytes payload, UnreadObject& unread, std::uint32_t index) = nullptr;
    // Checks what the numbers mean, of an object whose chunks before this one are valid; null: nothing to check.
    Status (*validate)(const RaySpaceObject& object, std::uint32_t index) = nullptr;
    // In memory, beyond sizeof of what it stands in; null: none.
    std::int64_t (*held_bytes)(const RaySpaceObject& object, std::uint32_t index) = nullptr;
};
inline Error wrong_size(std::uint64_t found, std::uint64_t expected) {
    return Error{"is " + std::to_string(found) + " bytes long instead of " + std::to_string(expected)};
}

template <class T>
std::int64_t held_by(const std::vector<T>& list) {
    return static_cast<std::int64_t>(list.capacity() * sizeof(T));
}

// NAME_chunk() is in chunks/NAME_chunk.cpp.
ChunkKind head_chunk();
ChunkKind rig_chunk();
ChunkKind views_chunk();
ChunkKind foot_chunk();
ChunkKind code_chunk();
ChunkKind ring_chunk();
ChunkKind map_chunk();
ChunkKind shape_chunk();
ChunkKind image_chunk();

}  // namespace rs::object_chunks
