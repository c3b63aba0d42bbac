// validate_object(): bounds required by the renderer's arithmetic; encode/FORMAT.md, section "Ranges".
#include "rayspace/format/chunk_table.hpp"
#include "rayspace/format/object_file.hpp"
#include "rayspace/format/object_ranges.hpp"

#include <algorithm>

namespace rs {
namespace {

using namespace object_chunks;

std::string place_of(ChunkScope each, std::uint32_t index) {
    if (each == ChunkScope::object) return "";
    return (each == ChunkScope::ring ? "ring " : "image ") + std::to_string(index) + ": ";
}

Status check_views_are_in_rings(const RaySpaceObject& object) {
    const std::vector<bool> is_in = object_ranges::ring_membership(object, object.rings.size());
    const auto free_view = std::find(is_in.begin(), is_in.end(), false);
    if (free_view == is_in.end()) return {};
    return Error{"view " + std::to_string(free_view - is_in.begin()) + " belongs to no ring"};
}

}  // namespace

Status validate_object(const RaySpaceObject& object, const std::string& where) {
    for (const ChunkScope each : {ChunkScope::object, ChunkScope::ring, ChunkScope::view}) {
        for (std::uint32_t index = 0; index < max_chunk_count(each, object); ++index) {
            for (const ChunkKind& kind : chunk_table()) {
                if (kind.each != each || kind.validate == nullptr) continue;
                const Status status = kind.validate(object, index);
                if (!status) return Error{where + ": " + place_of(each, index) + status.error().message};
            }
        }
        if (each != ChunkScope::ring) continue;
        if (const Status status = check_views_are_in_rings(object); !status)
            return Error{where + ": " + status.error().message};
    }
    return {};
}

}  // namespace rs
