#include "rayspace/format/object_reader.hpp"

#include "rayspace/codec/stream/coded_chunks.hpp"
#include "rayspace/codec/stream/decode_image.hpp"
#include "rayspace/format/chunk_table.hpp"

#include <algorithm>

namespace rs {

using namespace object_chunks;

Result<RaySpaceObject> ObjectReader::read() {
    RS_TRY(read_geometry());
    RS_TRY(read_maps());
    RS_TRY(read_shapes());
    RS_TRY(read_images());
    RS_TRY(validate_object(partial_.object, chunks_.where()));
    if (partial_.coded && options_.decode) codec::decode_images(partial_.object);
    return std::move(partial_.object);
}

Result<ReadMemory> ObjectReader::measure() {
    constexpr std::uint64_t kParsedOverText = 24;
    constexpr std::uint64_t kSmallThings_bytes = 1U << 20;
    RS_TRY(read_geometry());
    std::uint64_t kept = kSmallThings_bytes + memory_of_geometry();
    std::uint64_t kept_by_maps = 0;
    std::uint64_t largest_passing = 0;
    std::uint64_t largest_chunk = 0;
    for (const ChunkEntry& entry : chunks_.table()) {
        largest_chunk = std::max(largest_chunk, entry.size_bytes);
        if (partial_.coded && entry.name == kImage) kept += entry.size_bytes;
        const ChunkKind* const kind = find_chunk_kind(entry.name);
        if (kind == nullptr || kind->memory == nullptr) continue;
        RS_ASSIGN_OR_RETURN(const auto payload, read_payload(entry));
        const Result<ChunkMemory> takes = kind->memory(payload, partial_, entry.index);
        if (!takes) return in_chunk(*kind, entry.index, takes.error());
        kept_by_maps += takes->kept_bytes;
        largest_passing = std::max(largest_passing, takes->temporary_bytes);
    }
    const std::uint64_t passing = largest_chunk + largest_passing + kParsedOverText * partial_.object.rig_json.size();
    const std::uint64_t images = wanted_images();
    const std::uint64_t passing_planes = partial_.coded && options_.decode ? images * coded_planes_bytes() : 0;
    ReadMemory memory;
    memory.most_bytes = static_cast<std::int64_t>(kept + needed_bytes_ + kept_by_maps + passing);
    memory.object_bytes = static_cast<std::int64_t>(kept + needed_bytes_ + kept_by_maps - passing_planes);
    memory.width = partial_.object.width;
    memory.height = partial_.object.height;
    memory.images = static_cast<std::int64_t>(images);
    return memory;
}

Status ObjectReader::read_geometry() {
    RS_TRY(read_stage(ReadStage::geometry));
    RS_TRY(check_chunks());
    return check_memory();
}

Status ObjectReader::read_maps() {
    return read_stage(ReadStage::maps);
}

Status ObjectReader::read_shapes() {
    return read_stage(ReadStage::shapes);
}

Status ObjectReader::read_shape(std::uint32_t ring) {
    return read_each(ChunkScope::ring, ReadStage::shapes, ring);
}

Status ObjectReader::read_image(std::uint32_t view) {
    RS_TRY(read_each(ChunkScope::view, ReadStage::images, view));
    if (!partial_.coded) return {};
    needed_bytes_ += partial_.coded->images[view].bytes.size();
    return needed_bytes_ <= options_.memory_cap_bytes ? Status{} : Status{too_large(needed_bytes_)};
}

std::uint64_t ObjectReader::memory_of_geometry() const {
    std::uint64_t bytes = static_cast<std::uint64_t>(object_memory_bytes(partial_.object));
    for (const Ring& ring : partial_.object.rings)
        bytes += sizeof(NormalLine) * ring.views.size() * static_cast<std::uint64_t>(ring.planes);
    return bytes;
}

Error ObjectReader::in_chunk(const ChunkKind& kind, std::uint32_t index, const Error& error) const {
    return Error{chunks_.where() + ": chunk " + to_string(kind.name) + " " + std::to_string(index) + ": " +
                 error.message};
}

Result<std::vector<std::byte>> ObjectReader::read_payload(const ChunkEntry& entry) {
    if (entry.size_bytes > options_.memory_cap_bytes) return too_large(entry.size_bytes);
    return chunks_.read(entry);
}

// The memory stated by a chunk is checked against the limit before it is allocated, since a few bytes may state a lot.
Status ObjectReader::read_chunk(const ChunkKind& kind, std::uint32_t index) {
    const ChunkEntry* const entry = chunks_.find(kind.name, index);
    if (entry == nullptr) {
        if (kind.is_present != nullptr) return {};
        return Error{chunks_.where() + ": has no chunk " + to_string(kind.name) + " " + std::to_string(index)};
    }
    RS_ASSIGN_OR_RETURN(const auto payload, read_payload(*entry));
    if (kind.memory != nullptr) {
        const Result<ChunkMemory> takes = kind.memory(payload, partial_, index);
        if (!takes) return in_chunk(kind, index, takes.error());
        needed_bytes_ += takes->kept_bytes;
        const std::uint64_t most_bytes = needed_bytes_ + takes->temporary_bytes;
        if (most_bytes > options_.memory_cap_bytes) return too_large(most_bytes);
    }
    const Status parsed = kind.parse(payload, partial_, index);
    return parsed ? Status{} : in_chunk(kind, index, parsed.error());
}

Status ObjectReader::read_stage(ReadStage stage) {
    for (const ChunkScope each : {ChunkScope::object, ChunkScope::ring}) {
        for (std::uint32_t index = 0; index < max_chunk_count(each, partial_.object); ++index) {
            RS_TRY(read_each(each, stage, index));
        }
    }
    return {};
}

Status ObjectReader::read_each(ChunkScope each, ReadStage stage, std::uint32_t index) {
    for (const ChunkKind& kind : chunk_table()) {
        if (kind.each != each || kind.stage != stage) continue;
        RS_TRY(read_chunk(kind, index));
    }
    return {};
}

Status ObjectReader::read_images() {
    for (const Ring& ring : partial_.object.rings) {
        for (std::size_t n = 0; n < ring.views.size(); ++n) {
            if (is_wanted(ring, n)) RS_TRY(read_image(ring.views[n]));
        }
    }
    return {};
}

// Checks that the file contains the chunks of this object in the format's order, and otherwise only chunks that may be
// skipped.
Status ObjectReader::check_chunks() const {
    const std::vector<ChunkKey> expected = chunk_order(
        partial_.object,
        [&](const ChunkKind& kind, std::uint32_t index) { return chunks_.find(kind.name, index) != nullptr; });
    const auto named = [](ChunkKey key) { return to_string(key.name) + " " + std::to_string(key.index); };
    std::size_t next = 0;
    for (const ChunkEntry& entry : chunks_.table()) {
        const ChunkKey key{entry.name, entry.index};
        const bool may_be_skipped =
            entry.name[0] >= 'a' && entry.name[0] <= 'z' && find_chunk_kind(key.name) == nullptr;
        if (next < expected.size() && key == expected[next]) {
            ++next;
        } else if (!may_be_skipped) {
            return Error{chunks_.where() + ": chunk " + named(key) + " is unknown or out of place" +
                         (next < expected.size() ? ", where chunk " + named(expected[next]) + " should stand" : "") +
                         "; update these tools if the file is newer than they are"};
        }
    }
    if (next == expected.size()) return {};
    return Error{chunks_.where() + ": has no chunk " + named(expected[next]) + " in its place"};
}

// Checks the memory of maps and images, except memory stated by their own chunks.
Status ObjectReader::check_memory() {
    // No product reaches 2^64, since every factor is limited by conventions.hpp.
    for (const Ring& ring : partial_.object.rings) {
        needed_bytes_ += sizeof(std::uint16_t) * static_cast<std::uint64_t>(ring.planes) *
                         static_cast<std::uint64_t>(ring.x_cells) * static_cast<std::uint64_t>(ring.u_cells);
    }
    needed_bytes_ += wanted_images() * image_bytes();
    return needed_bytes_ <= options_.memory_cap_bytes ? Status{} : Status{too_large(needed_bytes_)};
}

std::uint64_t ObjectReader::wanted_images() const {
    std::uint64_t images = 0;
    for (const Ring& ring : partial_.object.rings) {
        for (std::size_t n = 0; n < ring.views.size(); ++n) images += is_wanted(ring, n) ? 1 : 0;
    }
    return images;
}

bool ObjectReader::is_wanted(const Ring& ring, std::size_t n) const {
    return level_of(partial_.object, ring, n) <= options_.max_level;
}

// Memory of one image: coded ones are decoded at full size, from planes that are slightly larger.
std::uint64_t ObjectReader::image_bytes() const {
    if (!partial_.coded) return raw_image_bytes(partial_.object.width, partial_.object.height);
    return codec::tile_table_bytes(*partial_.coded) + (options_.decode ? 2 * coded_planes_bytes() : 0);
}

std::uint64_t ObjectReader::coded_planes_bytes() const {
    constexpr std::uint64_t kCodedPlanes = 4;
    return kCodedPlanes * static_cast<std::uint64_t>(partial_.coded->coded_width()) *
           static_cast<std::uint64_t>(partial_.coded->coded_height());
}

Error ObjectReader::too_large(std::uint64_t needed_bytes) const {
    const auto mebibytes = [](std::uint64_t bytes) { return std::to_string((bytes + (1U << 20) - 1) >> 20) + " MiB"; };
    return Error{chunks_.where() + ": needs " + mebibytes(needed_bytes) + " of memory, more than the " +
                 mebibytes(options_.memory_cap_bytes) + " allowed; encode it with fewer or smaller images"};
}

}  // namespace rs
