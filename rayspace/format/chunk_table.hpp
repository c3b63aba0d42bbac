#pragma once
// Table of all chunks of an .rso file: their order, whether they are optional, their memory, and the functions that
// write, parse and validate them. encode/FORMAT.md, "Chunks".

#include "rayspace/format/chunks/chunk_kind.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rs::object_chunks {

/// Returns the table, a constant.
std::span<const ChunkKind> chunk_table();

/// The row of a chunk name; nullptr if it is unknown.
const ChunkKind* find_chunk_kind(ChunkName name);

/// The largest number of chunks of a kind in an object: 1, or one per ring or view.
std::size_t max_chunk_count(ChunkScope each, const RaySpaceObject& object);

struct ChunkKey {
    ChunkName name{};
    std::uint32_t index = 0;
    bool operator==(const ChunkKey&) const = default;
};

/// The chunks of an object in file order. Needs the rings' view lists and the levels of coded images.
/// \param has  returns true if an optional chunk is present.
std::vector<ChunkKey> chunk_order(const RaySpaceObject& object,
                                  const std::function<bool(const ChunkKind& kind, std::uint32_t index)>& has);
/// The chunks of an object in memory.
std::vector<ChunkKey> chunk_order(const RaySpaceObject& object);

/// The payload of a chunk as written by write_object().
Payload chunk_payload(const RaySpaceObject& object, ChunkKey key);

/// The progressive level of the n-th view of a ring; stored with each image if the images are coded.
int level_of(const RaySpaceObject& object, const Ring& ring, std::size_t n);

}  // namespace rs::object_chunks
