// Chunk foot: object.foot_q20, if it is known.
#include "rayspace/base/byte_stream.hpp"
#include "rayspace/format/chunks/chunk_kind.hpp"
#include "rayspace/format/object_ranges.hpp"

namespace rs::object_chunks {
namespace {

Payload foot_payload(const RaySpaceObject& object, std::uint32_t) {
    ByteWriter out;
    out.put(object.foot_q20.value());
    return out.bytes();
}

Status parse_foot(Bytes payload, PartialObject& partial, std::uint32_t) {
    if (payload.size() != sizeof(std::int32_t)) return wrong_size(payload.size(), sizeof(std::int32_t));
    partial.object.foot_q20 = ByteReader(payload).get<std::int32_t>();
    return {};
}

Status check_foot(const RaySpaceObject& object, std::uint32_t) {
    using namespace object_ranges;
    if (object.foot_q20 && !below(*object.foot_q20, kMaxDistance_q20)) {
        return Error{"its foot is 256 object radii or more from the height 0"};
    }
    return {};
}

}  // namespace

ChunkKind foot_chunk() {
    return {.name = kFoot,
            .is_present = [](const RaySpaceObject& object, std::uint32_t) { return object.foot_q20.has_value(); },
            .payload = foot_payload,
            .parse = parse_foot,
            .validate = check_foot};
}

}  // namespace rs::object_chunks
