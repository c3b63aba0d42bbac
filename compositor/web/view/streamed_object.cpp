#include "compositor/web/view/streamed_object.hpp"

#include "compositor/web/view/request_order.hpp"
#include "rayspace/format/chunk_table.hpp"
#include "rayspace/format/container_layout.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace rs::web {
namespace {

constexpr std::uint64_t kRequest_bytes = std::uint64_t{256} << 10;
constexpr std::size_t kJoined = 16;  // only chunks among the most wanted are joined
constexpr std::size_t kNotWanted = std::numeric_limits<std::size_t>::max();

bool overlap(const ByteRange& a, const ByteRange& b) {
    return a.begin < b.end && b.begin < a.end;
}

}  // namespace

StreamedObject::StreamedObject(const std::string& name, std::optional<std::uint64_t> size_bytes,
                               std::optional<ObjectView>& view)
    : stream_(name, size_bytes, {.memory_cap_bytes = kPageMemoryCap_bytes}), view_(view) {
    view_.reset();
}

Status StreamedObject::add(std::uint64_t offset, std::span<const std::byte> bytes) {
    Status added = stream_.add(offset, bytes);
    // Chunks before a damaged one are shown.
    if (stream_.has_maps()) RS_TRY(show_arrivals());
    return added;
}

Status StreamedObject::show_arrivals() {
    const ObjectStream::Arrivals arrivals = stream_.take_arrivals();
    new_photos_.insert(new_photos_.end(), arrivals.images.begin(), arrivals.images.end());
    if (!view_) {
        const bool is_coded = stream_.object().coded != nullptr;
        if (!is_coded && !stream_.is_complete()) return {};  // raw images are shown when all are there
        RS_ASSIGN_OR_RETURN(view_, ObjectView::create(is_coded ? stream_.object() : stream_.take_object()));
        return {};
    }
    for (const std::uint32_t ring : arrivals.shapes) view_->renderer().shape_arrived(ring, stream_.take_shape(ring));
    if (!arrivals.images.empty()) view_->renderer().images_arrived();
    return {};
}

bool StreamedObject::can_render(const OrbitView& view) const {
    if (!view_) return false;
    const Result<PreparedView> prepared = view_->prepare(view);
    return prepared.ok() && view_->renderer().has_images(prepared->rings.nearest.ring);
}

std::vector<std::uint32_t> StreamedObject::take_new_photos() {
    return std::exchange(new_photos_, {});
}

ByteRange StreamedObject::missing_bytes(std::size_t entry) const {
    const ChunkEntry& chunk = stream_.index().table()[entry];
    return {stream_.arrived_from(chunk.offset_bytes), chunk.offset_bytes + container_layout::aligned(chunk.size_bytes)};
}

std::vector<std::size_t> StreamedObject::wanted_entries(const OrbitView& view) const {
    const std::span<const ChunkEntry> table = stream_.index().table();
    std::vector<std::size_t> entries;
    if (stream_.has_maps() && view_) {
        for (const object_chunks::ChunkKey key : request_order(*view_, view)) {
            const ChunkEntry* const entry = stream_.index().find(key.name, key.index);
            if (entry != nullptr) entries.push_back(static_cast<std::size_t>(entry - table.data()));
        }
        return entries;
    }
    for (std::size_t i = 0; i < table.size(); ++i) {
        const object_chunks::ChunkKind* const kind = object_chunks::find_chunk_kind(table[i].name);
        if (kind == nullptr) continue;
        if (stream_.has_maps() || kind->stage <= object_chunks::ReadStage::maps) entries.push_back(i);
    }
    return entries;
}

ByteRange StreamedObject::next_range(const OrbitView& view, std::span<const ByteRange> requested) const {
    if (is_complete()) return {};
    const auto is_requested = [&](const ByteRange& bytes) {
        return std::any_of(requested.begin(), requested.end(),
                           [&](const ByteRange& each) { return overlap(each, bytes); });
    };
    if (!stream_.has_table()) {
        const ByteRange table{stream_.arrived_from(0), stream_.index().end_bytes()};
        return is_requested(table) ? ByteRange{} : table;
    }
    std::vector<std::size_t> rank(stream_.index().table().size(), kNotWanted);
    std::size_t count = 0;
    std::size_t first = 0;
    for (const std::size_t entry : wanted_entries(view)) {
        if (stream_.has_arrived(entry) || is_requested(missing_bytes(entry))) continue;
        if (count == 0) first = entry;
        rank[entry] = count++;
    }
    if (count == 0) return {};
    // The range grows by the more wanted of its two neighbours.
    ByteRange range = missing_bytes(first);
    std::size_t last = first;
    while (range.end - range.begin < kRequest_bytes) {
        const std::size_t before = first > 0 ? rank[first - 1] : kNotWanted;
        const std::size_t behind = last + 1 < rank.size() ? rank[last + 1] : kNotWanted;
        if (std::min(before, behind) > kJoined) break;
        const ByteRange neighbour = missing_bytes(before < behind ? first - 1 : last + 1);
        if (before < behind) {
            --first;
            range.begin = neighbour.begin;
        } else {
            ++last;
            range.end = neighbour.end;
        }
    }
    return range;
}

}  // namespace rs::web
