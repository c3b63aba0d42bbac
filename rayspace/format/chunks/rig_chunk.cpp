// Chunk RIGJ: object.rig_json in a Zstandard frame; uncompressed text is read, too.
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/zstd_frame.hpp"
#include "rayspace/format/chunks/chunk_kind.hpp"
#include "rayspace/geometry/rig_text.hpp"

#include <optional>

namespace rs::object_chunks {
namespace {

constexpr std::uint64_t kMaxRigJson_bytes = std::uint64_t{16} << 20;

Payload rig_payload(const RaySpaceObject& object, std::uint32_t) {
    return compress_zstd({reinterpret_cast<const std::uint8_t*>(object.rig_json.data()), object.rig_json.size()});
}

Status parse_rig_text(Bytes payload, PartialObject& partial, std::uint32_t) {
    if (payload.size() > kMaxRigJson_bytes)
        return out_of_range("the rig's length", payload.size(), 0, kMaxRigJson_bytes);
    const std::optional<std::uint64_t> expanded_bytes = read_zstd_content_size(payload);
    if (!expanded_bytes) {  // uncompressed
        partial.object.rig_json.assign(reinterpret_cast<const char*>(payload.data()), payload.size());
        return {};
    }
    if (*expanded_bytes > kMaxRigJson_bytes) {
        return out_of_range("the rig's length, expanded,", *expanded_bytes, 0, kMaxRigJson_bytes);
    }
    RS_ASSIGN_OR_RETURN(const std::vector<std::uint8_t> text,
                        decompress_zstd(payload, *expanded_bytes, "the words of its rig"));
    partial.object.rig_json.assign(text.begin(), text.end());
    return {};
}

Status check_rig(const RaySpaceObject& object, std::uint32_t) {
    if (object.rig_json.empty()) return {};
    if (object.rig_json.size() > kMaxRigJson_bytes) return Error{"its rig is larger than 16 MiB"};
    return check_rig_text(object.rig_json, object.views.size());
}

std::int64_t held_by_rig(const RaySpaceObject& object, std::uint32_t) {
    return static_cast<std::int64_t>(object.rig_json.capacity());
}

}  // namespace

ChunkKind rig_chunk() {
    return {.name = kRig,
            .payload = rig_payload,
            .parse = parse_rig_text,
            .validate = check_rig,
            .heap_bytes = held_by_rig};
}

}  // namespace rs::object_chunks
