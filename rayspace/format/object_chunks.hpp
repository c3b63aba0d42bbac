#pragma once
// Names of the chunks of an .rso file, and the chunk functions used outside of chunk_table.hpp. encode/FORMAT.md,
// section "Chunks".

#include "rayspace/base/result.hpp"
#include "rayspace/format/container.hpp"
#include "rayspace/format/content_coding.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::object_chunks {

inline constexpr ChunkName kHead = {'H', 'E', 'A', 'D'};
inline constexpr ChunkName kRig = {'R', 'I', 'G', 'J'};
inline constexpr ChunkName kViews = {'V', 'I', 'E', 'W'};
inline constexpr ChunkName kFoot = {'f', 'o', 'o', 't'};
inline constexpr ChunkName kRing = {'R', 'I', 'N', 'G'};
inline constexpr ChunkName kAxis = {'A', 'X', 'I', 'S'};
inline constexpr ChunkName kMap = {'R', 'M', 'A', 'P'};
inline constexpr ChunkName kShape = {'s', 'h', 'a', 'p'};
inline constexpr ChunkName kCode = {'C', 'O', 'D', 'E'};
inline constexpr ChunkName kImage = {'P', 'I', 'C', 'T'};

using Payload = std::vector<std::byte>;

/// RING r: all of object.rings[r] except its cells, and the lines of the ring's views. Views of other rings are
/// rejected.
enum class LineCoding : std::uint8_t { kPlain = 0, kResiduals = 1 };  // rayspace/format/line_coding.cpp
Payload ring_payload(const RaySpaceObject& object, std::size_t ring, LineCoding coding = LineCoding::kResiduals);
Status parse_ring(std::span<const std::byte> payload, RaySpaceObject& object, std::size_t ring);

/// RMAP r.
Payload map_payload(const Ring& ring);
Payload map_payload(const map_coding::Runs& runs);

/// The size of the planes of an uncoded PICT.
std::uint64_t raw_image_bytes(int width, int height);

}  // namespace rs::object_chunks
