#include "rayspace/format/chunk_table.hpp"

namespace rs::object_chunks {

std::span<const ChunkKind> chunk_table() {
    static const ChunkKind table[] = {
        head_chunk(),  rig_chunk(),  views_chunk(), foot_chunk(),  code_chunk(),  // per object
        ring_chunk(),  axis_chunk(), map_chunk(),   shape_chunk(),                // per ring
        image_chunk(),                                                            // per view
    };
    return table;
}

const ChunkKind* find_chunk_kind(ChunkName name) {
    for (const ChunkKind& kind : chunk_table()) {
        if (kind.name == name) return &kind;
    }
    return nullptr;
}

std::size_t max_chunk_count(ChunkScope each, const RaySpaceObject& object) {
    if (each == ChunkScope::object) return 1;
    return each == ChunkScope::ring ? object.rings.size() : object.images.size();
}

int level_of(const RaySpaceObject& object, const Ring& ring, std::size_t n) {
    return object.coded ? object.coded->levels[ring.views[n]] : progressive_level(static_cast<int>(n));
}

std::vector<ChunkKey> chunk_order(const RaySpaceObject& object,
                                  const std::function<bool(const ChunkKind&, std::uint32_t)>& has) {
    std::vector<ChunkKey> order;
    const auto add = [&](ChunkScope each, std::uint32_t index) {
        for (const ChunkKind& kind : chunk_table()) {
            if (kind.each == each && (kind.is_present == nullptr || has(kind, index)))
                order.push_back({kind.name, index});
        }
    };
    add(ChunkScope::object, 0);
    for (std::uint32_t r = 0; r < object.rings.size(); ++r) add(ChunkScope::ring, r);
    for (int level = 0; level < kProgressiveLevels; ++level) {
        for (const Ring& ring : object.rings) {
            for (std::size_t n = 0; n < ring.views.size(); ++n) {
                if (level_of(object, ring, n) == level) add(ChunkScope::view, ring.views[n]);
            }
        }
    }
    return order;
}

std::vector<ChunkKey> chunk_order(const RaySpaceObject& object) {
    return chunk_order(object,
                       [&](const ChunkKind& kind, std::uint32_t index) { return kind.is_present(object, index); });
}

Payload chunk_payload(const RaySpaceObject& object, ChunkKey key) {
    const ChunkKind* const kind = find_chunk_kind(key.name);
    RS_CHECK(kind != nullptr);
    return kind->payload(object, key.index);
}

}  // namespace rs::object_chunks
