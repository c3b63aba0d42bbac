#pragma once
// The payloads of an .rso file's chunks, one pair of functions per chunk: encode/FORMAT.md, section "Chunks".
//
// Parsers check what they need in order to read and to allocate safely: sizes, counts and caps; what the numbers mean
// is validate_object()'s to check. A parser's error message has no file name: the caller knows it.

#include "rayspace/base/result.hpp"
#include "rayspace/format/container.hpp"
#include "rayspace/format/map_coding.hpp"
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
inline constexpr ChunkName kMap = {'R', 'M', 'A', 'P'};
inline constexpr ChunkName kShape = {'s', 'h', 'a', 'p'};  // rayspace/format/shape_chunk.hpp
inline constexpr ChunkName kCode = {'C', 'O', 'D', 'E'};   // rayspace/codec/stream/coded_chunks.hpp
inline constexpr ChunkName kPicture = {'P', 'I', 'C', 'T'};

inline constexpr std::size_t kMaxName_bytes = 255;
inline constexpr std::uint64_t kMaxRigJson_bytes = std::uint64_t{16} << 20;

using Payload = std::vector<std::byte>;

// HEAD: object.name, units_per_radius, width and height; as many (empty) views and rings as there will be.
Payload head_payload(const RaySpaceObject& object);
Status parse_head(std::span<const std::byte> payload, RaySpaceObject& object);

// RIGJ: object.rig_json in a Zstandard frame; read as it is, too.
Payload rig_payload(const RaySpaceObject& object);
Status parse_rig_text(std::span<const std::byte> payload, RaySpaceObject& object);

// VIEW: what a view is without its lines. object.views has its size from HEAD.
Payload views_payload(const RaySpaceObject& object);
Status parse_views(std::span<const std::byte> payload, RaySpaceObject& object);

// foot: object.foot_q20, which must be there to be written.
Payload foot_payload(const RaySpaceObject& object);
Status parse_foot(std::span<const std::byte> payload, RaySpaceObject& object);

// RING r: everything of object.rings[r] but its cells, and the lines of the ring's views. A view that another ring has
// already is refused.
enum class LineCoding : std::uint8_t { kPlain = 0, kResiduals = 1 };  // rayspace/format/line_coding.hpp
Payload ring_payload(const RaySpaceObject& object, std::size_t ring, LineCoding coding = LineCoding::kResiduals);
Status parse_ring(std::span<const std::byte> payload, RaySpaceObject& object, std::size_t ring);

// RMAP r: the cells as runs along u. `ring` has its sizes from RING. A few bytes may hold many runs: the caller holds
// content_bytes against the memory that it allows itself before it expands them.
struct CodedMap {
    std::size_t rows = 0;
    std::size_t runs = 0;
    std::uint64_t content_bytes = 0;   // of the frame, while it is expanded
    std::span<const std::byte> frame;  // of the payload
};
Payload map_payload(const Ring& ring);
Payload map_payload(const map_coding::Runs& runs);
Result<CodedMap> parse_map_head(std::span<const std::byte> payload, const Ring& ring);
Status parse_map(const CodedMap& coded, Ring& ring);

// PICT v.
Payload picture_payload(const PlanarPicture& picture);
Status parse_picture(std::span<const std::byte> payload, int width, int height, PlanarPicture& picture);
std::uint64_t raw_picture_bytes(int width, int height);

}  // namespace rs::object_chunks
