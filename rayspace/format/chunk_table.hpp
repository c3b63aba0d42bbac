#pragma once
// All chunks that an .rso file's object is made of, in one table: the order of the file, which of them may lack, what
// they take in memory, and the functions that write and parse them (object_chunks.hpp). encode/FORMAT.md, "Chunks".

#include "rayspace/format/object_chunks.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace rs::object_chunks {

// An object that is being read.
struct UnreadObject {
    RaySpaceObject object;
    std::shared_ptr<codec::CodedPictures> coded;  // object.coded, while it is filled
};

// What parsing a chunk takes beyond a small multiple of its payload.
struct ChunkMemory {
    std::uint64_t kept_bytes = 0;     // by the object
    std::uint64_t passing_bytes = 0;  // while it is parsed
};

// Read one after the other. Everything of the first is bound by counts that its chunks' parsers check.
enum class ReadStage { geometry, maps, pictures };
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
    Result<ChunkMemory> (*memory)(std::span<const std::byte> payload, UnreadObject& object,
                                  std::uint32_t index) = nullptr;
    Status (*parse)(std::span<const std::byte> payload, UnreadObject& object, std::uint32_t index) = nullptr;
};
std::span<const ChunkKind> chunk_table();

struct ChunkKey {
    ChunkName name{};
    std::uint32_t index = 0;
    bool operator==(const ChunkKey&) const = default;
};

// The chunks of an object in the order of the file. Needs the rings' view lists and the levels of coded pictures;
// `has` tells whether there is one of a kind that may lack.
std::vector<ChunkKey> chunk_order(const RaySpaceObject& object,
                                  const std::function<bool(const ChunkKind& kind, std::uint32_t index)>& has);
// Of an object in memory.
std::vector<ChunkKey> chunk_order(const RaySpaceObject& object);

// The payload of one of these, as write_object() stores it.
Payload chunk_payload(const RaySpaceObject& object, ChunkKey key);

// The level at which the n-th view of a ring is loaded: a coded picture says it itself.
int level_of(const RaySpaceObject& object, const Ring& ring, std::size_t n);

}  // namespace rs::object_chunks
