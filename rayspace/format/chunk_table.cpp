#include "rayspace/format/chunk_table.hpp"

#include "rayspace/codec/stream/coded_chunks.hpp"
#include "rayspace/format/shape_chunk.hpp"

#include <algorithm>

namespace rs::object_chunks {
namespace {

using Bytes = std::span<const std::byte>;
using Object = const RaySpaceObject&;
using Unread = UnreadObject&;
using Index = std::uint32_t;

// The numbers of a map's frame and the runs that they are stand in memory at once.
constexpr std::uint64_t kRunsOverContent = 2;

Status parse_code(Bytes payload, Unread unread, Index) {
    RaySpaceObject& object = unread.object;
    unread.coded = std::make_shared<codec::CodedPictures>();
    object.coded = unread.coded;
    return codec::parse_code(payload, object.views.size(), object.width, object.height, *unread.coded);
}

Result<ChunkMemory> map_memory(Bytes payload, Unread unread, Index r) {
    const auto coded = parse_map_head(payload, unread.object.rings[r]);
    if (!coded) return coded.error();
    return ChunkMemory{.passing_bytes = kRunsOverContent * coded->content_bytes};
}

Status parse_map(Bytes payload, Unread unread, Index r) {
    const auto coded = parse_map_head(payload, unread.object.rings[r]);
    return coded ? parse_map(*coded, unread.object.rings[r]) : coded.error();
}

Result<ChunkMemory> shape_memory(Bytes payload, Unread unread, Index r) {
    const auto coded = parse_shape_head(payload, unread.object.rings[r]);
    if (!coded) return coded.error();
    return ChunkMemory{.kept_bytes = coded->cells * sizeof(ShapeCell)};
}

Status parse_shape(Bytes payload, Unread unread, Index r) {
    const auto coded = parse_shape_head(payload, unread.object.rings[r]);
    return coded ? parse_shape_cells(*coded, unread.object.rings[r].shape) : coded.error();
}

Payload view_payload(Object object, Index view) {
    return object.coded ? codec::coded_picture_payload(*object.coded, view) : picture_payload(object.pictures[view]);
}

Status parse_view(Bytes payload, Unread unread, Index view) {
    if (unread.coded) return codec::parse_coded_picture(payload, view, *unread.coded);
    RaySpaceObject& object = unread.object;
    return parse_picture(payload, object.width, object.height, object.pictures[view]);
}

constexpr ChunkKind kTable[] = {
    {.name = kHead,
     .payload = [](Object o, Index) { return head_payload(o); },
     .parse = [](Bytes b, Unread u, Index) { return parse_head(b, u.object); }},
    {.name = kRig,
     .payload = [](Object o, Index) { return rig_payload(o); },
     .parse = [](Bytes b, Unread u, Index) { return parse_rig_text(b, u.object); }},
    {.name = kViews,
     .payload = [](Object o, Index) { return views_payload(o); },
     .parse = [](Bytes b, Unread u, Index) { return parse_views(b, u.object); }},
    {.name = kFoot,
     .is_there = [](Object o, Index) { return o.foot_q20.has_value(); },
     .payload = [](Object o, Index) { return foot_payload(o); },
     .parse = [](Bytes b, Unread u, Index) { return parse_foot(b, u.object); }},
    {.name = kCode,
     .is_there = [](Object o, Index) { return o.coded != nullptr; },
     .payload = [](Object o, Index) { return codec::code_payload(*o.coded); },
     .parse = parse_code},
    {.name = kRing,
     .each = OneFor::ring,
     .payload = [](Object o, Index r) { return ring_payload(o, r); },
     .parse = [](Bytes b, Unread u, Index r) { return parse_ring(b, u.object, r); }},
    {.name = kMap,
     .each = OneFor::ring,
     .stage = ReadStage::maps,
     .payload = [](Object o, Index r) { return map_payload(o.rings[r]); },
     .memory = map_memory,
     .parse = parse_map},
    {.name = kShape,
     .each = OneFor::ring,
     .stage = ReadStage::maps,
     .is_there = [](Object o, Index r) { return !o.rings[r].shape.empty(); },
     .payload = [](Object o, Index r) { return shape_payload(o.rings[r]); },
     .memory = shape_memory,
     .parse = parse_shape},
    {.name = kPicture,
     .each = OneFor::view,
     .stage = ReadStage::pictures,
     .payload = view_payload,
     .parse = parse_view},
};

}  // namespace

std::span<const ChunkKind> chunk_table() {
    return kTable;
}

int level_of(const RaySpaceObject& object, const Ring& ring, std::size_t n) {
    return object.coded ? object.coded->levels[ring.views[n]] : progressive_level(static_cast<int>(n));
}

std::vector<ChunkKey> chunk_order(const RaySpaceObject& object,
                                  const std::function<bool(const ChunkKind&, std::uint32_t)>& has) {
    std::vector<ChunkKey> order;
    const auto add = [&](OneFor each, std::uint32_t index) {
        for (const ChunkKind& kind : kTable) {
            if (kind.each == each && (kind.is_there == nullptr || has(kind, index)))
                order.push_back({kind.name, index});
        }
    };
    add(OneFor::object, 0);
    for (std::uint32_t r = 0; r < object.rings.size(); ++r) add(OneFor::ring, r);
    for (int level = 0; level < kProgressiveLevels; ++level) {
        for (const Ring& ring : object.rings) {
            for (std::size_t n = 0; n < ring.views.size(); ++n) {
                if (level_of(object, ring, n) == level) add(OneFor::view, ring.views[n]);
            }
        }
    }
    return order;
}

std::vector<ChunkKey> chunk_order(const RaySpaceObject& object) {
    return chunk_order(object,
                       [&](const ChunkKind& kind, std::uint32_t index) { return kind.is_there(object, index); });
}

Payload chunk_payload(const RaySpaceObject& object, ChunkKey key) {
    const auto kind = std::ranges::find(kTable, key.name, &ChunkKind::name);
    RS_CHECK(kind != std::end(kTable));
    return kind->payload(object, key.index);
}

}  // namespace rs::object_chunks
