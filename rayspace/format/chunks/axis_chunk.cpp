// Chunk AXIS: the rotation of a ring whose axis is not the object's.
#include "rayspace/base/byte_stream.hpp"
#include "rayspace/format/chunks/chunk_kind.hpp"
#include "rayspace/format/object_ranges.hpp"

#include <cmath>

namespace rs::object_chunks {
namespace {

constexpr std::size_t kAxis_bytes = 4 * sizeof(std::int32_t);
constexpr double kNormTolerance = 1e-6;

Payload axis_payload(const RaySpaceObject& object, std::uint32_t ring) {
    const RingRotation& rotation = object.rings[ring].rotation;
    ByteWriter out;
    out.put(rotation.x_q30);
    out.put(rotation.y_q30);
    out.put(rotation.z_q30);
    out.put(rotation.w_q30);
    return out.bytes();
}

Status parse_axis(Bytes payload, PartialObject& partial, std::uint32_t ring) {
    if (payload.size() != kAxis_bytes) return wrong_size(payload.size(), kAxis_bytes);
    RingRotation& rotation = partial.object.rings[ring].rotation;
    ByteReader in(payload);
    rotation.x_q30 = in.get<std::int32_t>();
    rotation.y_q30 = in.get<std::int32_t>();
    rotation.z_q30 = in.get<std::int32_t>();
    rotation.w_q30 = in.get<std::int32_t>();
    if (rotation.is_identity()) return Error{"is the identity; a ring about the object's axis has no such chunk"};
    return {};
}

Status check_axis(const RaySpaceObject& object, std::uint32_t ring) {
    const RingRotation& rotation = object.rings[ring].rotation;
    double norm = 0;
    for (const std::int32_t q30 : {rotation.x_q30, rotation.y_q30, rotation.z_q30, rotation.w_q30}) {
        norm += std::ldexp(static_cast<double>(q30) * q30, -60);
    }
    if (!(std::abs(norm - 1) <= kNormTolerance)) return Error{"its rotation is not a unit quaternion"};
    return {};
}

}  // namespace

ChunkKind axis_chunk() {
    return {.name = kAxis,
            .each = ChunkScope::ring,
            .is_present = [](const RaySpaceObject& object,
                             std::uint32_t r) { return !object.rings[r].rotation.is_identity(); },
            .payload = axis_payload,
            .parse = parse_axis,
            .validate = check_axis};
}

}  // namespace rs::object_chunks
