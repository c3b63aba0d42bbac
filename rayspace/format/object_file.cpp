#include "rayspace/format/object_file.hpp"

#include "rayspace/codec/stream/coded_chunks.hpp"
#include "rayspace/codec/stream/decode_picture.hpp"
#include "rayspace/format/container_layout.hpp"
#include "rayspace/format/object_chunks.hpp"
#include "rayspace/format/object_memory.hpp"
#include "rayspace/format/shape_chunk.hpp"

#include <algorithm>

namespace rs {

using namespace object_chunks;

namespace {

// Of a map, the numbers of its frame and the runs that they are stand in memory at once.
constexpr std::uint64_t kRunsOverContent = 2;

Error in_chunk(const std::string& where, ChunkKey key, const Status& status) {
    return Error{where + ": chunk " + to_string(key.name) + " " + std::to_string(key.index) + ": " +
                 status.error().message};
}

// Reads one object; holds what the steps share.
class ObjectReader {
public:
    ObjectReader(const ContainerReader& container, const ReadObjectOptions& options)
        : container_(container), options_(options) {}

    Result<RaySpaceObject> read() {
        if (const Status status = read_geometry(); !status) return status.error();
        if (const Status status = check_chunks(); !status) return status.error();
        if (const Status status = check_memory(); !status) return status.error();
        if (const Status status = read_maps(); !status) return status.error();
        if (const Status status = read_pictures(); !status) return status.error();
        if (const Status status = validate_object(object_, container_.where()); !status) return status.error();
        if (coded_ && options_.decode) codec::decode_pictures(object_);
        return std::move(object_);
    }

    // Nothing that is large is read. What is small is bounded by what its chunks take: the text of a rig, which is
    // parsed, is the worst.
    Result<ReadingMemory> measure() {
        constexpr std::uint64_t kParsedOverText = 24;
        constexpr std::uint64_t kSmallThings_bytes = 1U << 20;
        if (const Status status = read_geometry(); !status) return status.error();
        if (const Status status = check_chunks(); !status) return status.error();
        if (const Status status = check_memory(); !status) return status.error();
        std::uint64_t kept = kSmallThings_bytes + memory_of_geometry();
        std::uint64_t shape_cells = 0;
        std::uint64_t largest_map = 0;
        std::uint64_t largest_chunk = 0;
        std::uint64_t pictures = 0;
        for (std::uint32_t r = 0; r < object_.rings.size(); ++r) {
            const Ring& ring = object_.rings[r];
            for (std::size_t n = 0; n < ring.views.size(); ++n) pictures += is_wanted(ring, n) ? 1 : 0;
            const auto count_cells = [&](std::span<const std::byte> payload) -> Status {
                const auto coded = parse_shape_head(payload, object_.rings[r]);
                if (!coded) return coded.error();
                shape_cells += coded->cells * sizeof(ShapeCell);
                return {};
            };
            const auto count_runs = [&](std::span<const std::byte> payload) -> Status {
                const auto coded = parse_map_head(payload, ring);
                if (!coded) return coded.error();
                largest_map = std::max(largest_map, kRunsOverContent * coded->content_bytes);
                return {};
            };
            if (const Status status = read_chunk({kMap, r}, count_runs); !status) return status.error();
            if (container_.find(kShape, r) == nullptr) continue;
            if (const Status status = read_chunk({kShape, r}, count_cells); !status) return status.error();
        }
        for (const ChunkEntry& entry : container_.table()) {
            largest_chunk = std::max(largest_chunk, entry.size_bytes);
            if (coded_ && entry.name == kPicture) kept += entry.size_bytes;
        }
        const std::uint64_t passing = largest_chunk + largest_map + kParsedOverText * object_.rig_json.size();
        // Cells are unpacked from planes of bytes, one for each byte of a cell.
        const std::uint64_t most = kept + needed_bytes_ + 2 * shape_cells + passing;
        const std::uint64_t passing_planes = coded_ && options_.decode ? pictures * coded_planes_bytes() : 0;
        ReadingMemory memory;
        memory.most_bytes = static_cast<std::int64_t>(most);
        memory.object_bytes = static_cast<std::int64_t>(kept + needed_bytes_ + shape_cells - passing_planes);
        memory.width = object_.width;
        memory.height = object_.height;
        memory.pictures = static_cast<std::int64_t>(pictures);
        return memory;
    }

private:
    [[nodiscard]] std::uint64_t memory_of_geometry() const {
        std::uint64_t bytes = static_cast<std::uint64_t>(memory_of(object_));
        for (const Ring& ring : object_.rings)
            bytes += sizeof(NormalLine) * ring.views.size() * static_cast<std::uint64_t>(ring.planes);
        return bytes;
    }

    // parse(payload) of one chunk, which must be there.
    template <class Parse>
    Status read_chunk(ChunkKey key, Parse&& parse) {
        const ChunkEntry* const entry = container_.find(key.name, key.index);
        if (entry == nullptr) {
            return Error{container_.where() + ": has no chunk " + to_string(key.name) + " " +
                         std::to_string(key.index)};
        }
        if (entry->size_bytes > options_.memory_cap_bytes) return too_large(entry->size_bytes);
        const auto payload = container_.read(*entry);
        if (!payload) return payload.error();
        if (Status status = parse(std::span<const std::byte>(*payload)); !status) {
            return in_chunk(container_.where(), key, status);
        }
        return {};
    }

    // Everything that is small: its size is bound by counts that are checked before.
    Status read_geometry() {
        using Bytes = std::span<const std::byte>;
        if (Status s = read_chunk({kHead, 0}, [&](Bytes b) { return parse_head(b, object_); }); !s) return s;
        if (Status s = read_chunk({kRig, 0}, [&](Bytes b) { return parse_rig_text(b, object_); }); !s) return s;
        if (Status s = read_chunk({kViews, 0}, [&](Bytes b) { return parse_views(b, object_); }); !s) return s;
        if (container_.find(kFoot, 0) != nullptr) {
            if (Status s = read_chunk({kFoot, 0}, [&](Bytes b) { return parse_foot(b, object_); }); !s) return s;
        }
        if (container_.find(kCode, 0) != nullptr) {
            coded_ = std::make_shared<codec::CodedPictures>();
            object_.coded = coded_;
            const auto parse = [&](Bytes b) {
                return codec::parse_code(b, object_.views.size(), object_.width, object_.height, *coded_);
            };
            if (Status s = read_chunk({kCode, 0}, parse); !s) return s;
        }
        for (std::uint32_t r = 0; r < object_.rings.size(); ++r) {
            if (Status s = read_chunk({kRing, r}, [&](Bytes b) { return parse_ring(b, object_, r); }); !s) return s;
        }
        return {};
    }

    // The file holds the chunks of this object, in the format's order, and else only what may be skipped. A shape map,
    // if there is one, stands behind its ring's map.
    Status check_chunks() const {
        const std::vector<ChunkKey> expected = chunk_order(object_);
        std::size_t next = 0;
        for (const ChunkEntry& entry : container_.table()) {
            const ChunkKey key{entry.name, entry.index};
            if (next < expected.size() && key == expected[next]) {
                ++next;
            } else if (entry.name == kShape) {
                if (next > 0 && expected[next - 1] == ChunkKey{kMap, entry.index}) continue;
                return Error{container_.where() + ": chunk " + to_string(entry.name) + " " +
                             std::to_string(entry.index) + " does not stand behind a chunk " + to_string(kMap) + " " +
                             std::to_string(entry.index) + "; encode the object anew"};
            } else if (entry.name == kFoot) {
                return Error{container_.where() + ": chunk " + to_string(entry.name) + " " +
                             std::to_string(entry.index) + " is not the one behind chunk " + to_string(kViews) +
                             " 0; encode the object anew"};
            } else if (entry.name[0] >= 'A' && entry.name[0] <= 'Z') {
                return Error{container_.where() + ": chunk " + to_string(entry.name) + " " +
                             std::to_string(entry.index) +
                             " is unknown or out of place; update these tools if the file is newer than they are"};
            }
        }
        if (next == expected.size()) return {};
        return Error{container_.where() + ": has no chunk " + to_string(expected[next].name) + " " +
                     std::to_string(expected[next].index) + " in its place"};
    }

    // What the maps and pictures need, but for shape maps: see read_shape().
    Status check_memory() {
        // No product here reaches 2^64: every factor is capped by conventions.hpp.
        std::uint64_t pictures = 0;
        for (const Ring& ring : object_.rings) {
            needed_bytes_ += sizeof(std::uint16_t) * static_cast<std::uint64_t>(ring.planes) *
                             static_cast<std::uint64_t>(ring.x_cells) * static_cast<std::uint64_t>(ring.u_cells);
            for (std::size_t n = 0; n < ring.views.size(); ++n) pictures += is_wanted(ring, n) ? 1 : 0;
        }
        needed_bytes_ += pictures * picture_bytes();
        return needed_bytes_ <= options_.memory_cap_bytes ? Status{} : Status{too_large(needed_bytes_)};
    }

    Status read_maps() {
        for (std::uint32_t r = 0; r < object_.rings.size(); ++r) {
            if (Status status = read_map(r); !status) return status;
            if (container_.find(kShape, r) == nullptr) continue;
            if (Status status = read_shape(r); !status) return status;
        }
        return {};
    }

    // The cells are counted already; not so what they are expanded from, which may be more than they.
    Status read_map(std::uint32_t r) {
        std::uint64_t needed_bytes = 0;
        const Status status = read_chunk({kMap, r}, [&](std::span<const std::byte> payload) -> Status {
            const auto coded = parse_map_head(payload, object_.rings[r]);
            if (!coded) return coded.error();
            needed_bytes = needed_bytes_ + kRunsOverContent * coded->content_bytes;
            return needed_bytes <= options_.memory_cap_bytes ? parse_map(*coded, object_.rings[r]) : Status{};
        });
        return needed_bytes <= options_.memory_cap_bytes ? status : Status{too_large(needed_bytes)};
    }

    // How large the cells are is known only from the chunk itself, which may be small: so they are added to the other
    // memory here, before they are allocated.
    Status read_shape(std::uint32_t r) {
        Ring& ring = object_.rings[r];
        bool fits = true;
        const Status status = read_chunk({kShape, r}, [&](std::span<const std::byte> payload) -> Status {
            const auto coded = parse_shape_head(payload, ring);
            if (!coded) return coded.error();
            needed_bytes_ += coded->cells * sizeof(ShapeCell);
            fits = needed_bytes_ <= options_.memory_cap_bytes;
            return fits ? parse_shape_cells(*coded, ring.shape) : Status{};
        });
        return fits ? status : Status{too_large(needed_bytes_)};
    }

    Status read_pictures() {
        for (const Ring& ring : object_.rings) {
            for (std::size_t n = 0; n < ring.views.size(); ++n) {
                if (!is_wanted(ring, n)) continue;
                const std::uint16_t view = ring.views[n];
                const auto parse = [&](std::span<const std::byte> b) {
                    if (coded_) return codec::parse_coded_picture(b, view, *coded_);
                    return parse_picture(b, object_.width, object_.height, object_.pictures[view]);
                };
                if (Status status = read_chunk({kPicture, view}, parse); !status) return status;
                if (!coded_) continue;
                needed_bytes_ += coded_->pictures[view].bytes.size();
                if (needed_bytes_ > options_.memory_cap_bytes) return too_large(needed_bytes_);
            }
        }
        return {};
    }

    [[nodiscard]] bool is_wanted(const Ring& ring, std::size_t n) const {
        return level_of(object_, ring, n) <= options_.max_level;
    }

    // What a picture will take: a coded one is unpacked at full size, from planes that are a little larger.
    [[nodiscard]] std::uint64_t picture_bytes() const {
        if (!coded_) return raw_picture_bytes(object_.width, object_.height);
        return codec::tile_table_bytes(*coded_) + (options_.decode ? 2 * coded_planes_bytes() : 0);
    }

    [[nodiscard]] std::uint64_t coded_planes_bytes() const {
        constexpr std::uint64_t kCodedPlanes = 4;
        return kCodedPlanes * static_cast<std::uint64_t>(coded_->coded_width()) *
               static_cast<std::uint64_t>(coded_->coded_height());
    }

    [[nodiscard]] Error too_large(std::uint64_t needed_bytes) const {
        const auto mebibytes = [](std::uint64_t bytes) {
            return std::to_string((bytes + (1U << 20) - 1) >> 20) + " MiB";
        };
        return Error{container_.where() + ": needs " + mebibytes(needed_bytes) + " of memory, more than the " +
                     mebibytes(options_.memory_cap_bytes) + " allowed; encode it with fewer or smaller pictures"};
    }

    const ContainerReader& container_;
    const ReadObjectOptions& options_;
    RaySpaceObject object_;
    std::shared_ptr<codec::CodedPictures> coded_;  // object_.coded, while it is filled
    std::uint64_t needed_bytes_ = 0;               // of the memory cap
};

}  // namespace

Status write_object(const std::filesystem::path& path, const RaySpaceObject& object, Progress* progress) {
    if (Status status = validate_object(object, path.string()); !status) return status;
    for (std::size_t i = 0; i < object.pictures.size(); ++i) {
        if (object.coded ? !object.coded->pictures[i].loaded() : object.pictures[i].empty()) {
            return Error{path.string() + ": picture " + std::to_string(i) +
                         " is not loaded; an object is written whole"};
        }
    }
    const std::vector<ChunkKey> order = chunk_order(object);
    auto writer = ContainerWriter::create(path, static_cast<std::uint32_t>(order.size()));
    if (!writer) return writer.error();
    if (progress != nullptr) progress->start("writing", static_cast<std::int64_t>(order.size()));
    for (const ChunkKey key : order) {
        if (Status status = writer->add(key.name, key.index, chunk_payload(object, key)); !status) return status;
        if (progress != nullptr) progress->advance();
    }
    Status status = writer->commit();
    if (progress != nullptr) progress->finish();
    return status;
}

Result<RaySpaceObject> read_object(const ContainerReader& container, const ReadObjectOptions& options) {
    return ObjectReader(container, options).read();
}

Result<RaySpaceObject> read_object(const std::filesystem::path& path, const ReadObjectOptions& options) {
    const auto container = ContainerReader::open(path);
    if (!container) return container.error();
    return read_object(*container, options);
}

Result<ReadingMemory> memory_to_read(const ContainerReader& container, const ReadObjectOptions& options) {
    return ObjectReader(container, options).measure();
}

std::vector<ChunkSummary> summarise_chunks(const ContainerReader& container) {
    std::vector<ChunkSummary> summaries;
    for (const ChunkEntry& entry : container.table()) {
        const std::string name = to_string(entry.name);
        auto found = std::find_if(summaries.begin(), summaries.end(), [&](const auto& s) { return s.name == name; });
        if (found == summaries.end()) found = summaries.insert(found, {name, 0, 0});
        ++found->count;
        found->size_bytes += entry.size_bytes;
    }
    return summaries;
}

}  // namespace rs
