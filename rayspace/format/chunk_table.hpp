#pragma once
// All chunks that an .rso file's object is made of, in one table: the order of the file, which of them may lack, what
// they take in memory, and the functions that write, parse and validate them. encode/FORMAT.md, "Chunks".

#include "rayspace/format/chunks/chunk_kind.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rs::object_chunks {

// A thread-safe constant.
std::span<const ChunkKind> chunk_table();

// How many chunks of a kind an object has at most: 1, or one for each ring or view.
std::size_t count_of(OneFor each, const RaySpaceObject& object);

struct ChunkKey {
    ChunkName name{};
    std::uint32_t index = 0;
    bool operator==(const ChunkKey&) const = default;
};

// The chunks of an object in the order of the file. Needs the rings' view lists and the levels of coded images;
// `has` returns whether there is one of a kind that may be missing.
std::vector<ChunkKey> chunk_order(const RaySpaceObject& object,
                                  const std::function<bool(const ChunkKind& kind, std::uint32_t index)>& has);
// Of an object in memory.
std::vector<ChunkKey> chunk_order(const RaySpaceObject& object);

// The payload of one of these, as write_object() stores it.
Payload chunk_payload(const RaySpaceObject& object, ChunkKey key);

// The level at which the n-th view of a ring is loaded: a coded image states it itself.
int level_of(const RaySpaceObject& object, const Ring& ring, std::size_t n);

}  // namespace rs::object_chunks
