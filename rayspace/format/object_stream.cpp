#include "rayspace/format/object_stream.hpp"

#include "rayspace/format/chunk_table.hpp"
#include "rayspace/format/container_layout.hpp"
#include "rayspace/format/object_reader.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace rs {

using namespace container_layout;
using namespace object_chunks;

// Chunks that have arrived are `waiting` until their stage can be read.
struct ObjectStream::State final : ChunkSource {
    // Bytes from `begin` on that have arrived without a gap and are not parsed yet.
    struct Run {
        std::uint64_t begin = 0;
        std::vector<std::byte> bytes;
        [[nodiscard]] std::uint64_t end() const { return begin + bytes.size(); }
    };

    State(std::string name, std::optional<std::uint64_t> size, const ReadObjectOptions& read_options)
        : file(std::move(name)), size_bytes(size), options(read_options), reader(*this, options) {}

    [[nodiscard]] const std::string& where() const override { return file; }
    [[nodiscard]] std::span<const ChunkEntry> table() const override { return index.table(); }
    [[nodiscard]] const ChunkEntry* find(ChunkName name, std::uint32_t number) const override {
        return index.find(name, number);
    }
    Result<std::vector<std::byte>> read(const ChunkEntry& entry) override {
        const auto found = waiting.find(position(entry));
        RS_CHECK(found != waiting.end());
        std::vector<std::byte> payload = std::move(found->second);
        waiting.erase(found);
        return payload;
    }

    [[nodiscard]] std::size_t position(const ChunkEntry& entry) const {
        return static_cast<std::size_t>(&entry - table().data());
    }

    Status add(std::uint64_t offset, std::span<const std::byte> bytes);
    Status consume(Run& run);
    Status read_table(Run& run);
    Status start_table();
    Status accept(std::size_t entry, std::vector<std::byte> bytes);
    Status read_stages();
    Status read_waiting();
    Status read_late_chunk(std::size_t entry);
    void forget_stale_runs();

    std::string file;
    std::optional<std::uint64_t> size_bytes;
    ReadObjectOptions options;
    ObjectReader reader;
    ContainerIndex index;
    bool has_header = false;
    bool has_maps = false;
    bool has_images = false;
    bool reads_shapes = false;
    std::vector<bool> arrived;                              // [entry]
    std::size_t missing = 0;                                // entries that have not arrived
    std::size_t missing_before[2] = {0, 0};                 // of those of the stages geometry and maps
    std::map<std::size_t, std::vector<std::byte>> waiting;  // [entry]: payload
    std::map<std::uint64_t, Run> runs;                      // by their end
    Arrivals arrivals;
    Status failure;
};

Status ObjectStream::State::add(std::uint64_t offset, std::span<const std::byte> bytes) {
    const std::uint64_t limit_bytes = has_header ? index.size_bytes() : size_bytes.value_or(kMaxContainer_bytes);
    if (offset > limit_bytes || bytes.size() > limit_bytes - offset) {
        return has_header ? index.wrong_file_size(offset + bytes.size())
                          : Error{file + ": is longer than the server has stated; load it again"};
    }
    Run run{offset, {}};
    if (const auto found = runs.find(offset); found != runs.end()) {
        run = std::move(found->second);
        runs.erase(found);
    }
    run.bytes.insert(run.bytes.end(), bytes.begin(), bytes.end());
    reads_shapes = has_images;
    RS_TRY(consume(run));
    if (!table().empty() && missing == 0) {
        reads_shapes = true;
        RS_TRY(read_waiting());
    }
    if (!run.bytes.empty()) runs.insert_or_assign(run.end(), std::move(run));
    forget_stale_runs();
    return {};
}

// Parses the chunks that are whole, and skips what is not needed.
Status ObjectStream::State::consume(Run& run) {
    if (table().empty()) RS_TRY(read_table(run));
    if (table().empty()) return {};
    std::uint64_t at = std::max(run.begin, std::min(index.end_bytes(), run.end()));
    while (at < run.end()) {
        const auto behind =
            std::upper_bound(table().begin(), table().end(), at,
                             [](std::uint64_t offset, const ChunkEntry& entry) { return offset < entry.offset_bytes; });
        if (behind == table().begin()) break;
        const ChunkEntry& entry = *std::prev(behind);
        const std::uint64_t size = aligned(entry.size_bytes);
        const std::uint64_t end = entry.offset_bytes + size;
        if (arrived[position(entry)] || at != entry.offset_bytes) {
            at = std::min(end, run.end());
            continue;
        }
        if (end > run.end()) break;
        const auto first = run.bytes.begin() + static_cast<std::ptrdiff_t>(at - run.begin);
        RS_TRY(accept(position(entry), {first, first + static_cast<std::ptrdiff_t>(size)}));
        at = end;
    }
    run.bytes.erase(run.bytes.begin(), run.bytes.begin() + static_cast<std::ptrdiff_t>(at - run.begin));
    run.begin = at;
    return {};
}

// Bytes of other places are dropped until the table is there.
Status ObjectStream::State::read_table(Run& run) {
    if (run.begin != 0) {
        run.bytes.clear();
        return {};
    }
    if (!has_header) {
        if (run.bytes.size() < kHeader_bytes) return {};
        const auto start = std::span(run.bytes).first(static_cast<std::size_t>(kHeader_bytes));
        RS_ASSIGN_OR_RETURN(index, ContainerIndex::from_header(start, size_bytes, file));
        has_header = true;
        if (index.size_bytes() > options.memory_cap_bytes) {
            return index.wrong("is larger than the " + std::to_string(options.memory_cap_bytes >> 20) +
                               " MiB of memory allowed; encode it with fewer or smaller images");
        }
    }
    if (run.bytes.size() < index.end_bytes()) return {};
    const auto table_bytes = static_cast<std::size_t>(index.end_bytes() - kTableOffset_bytes);
    RS_TRY(index.read_table(std::span(run.bytes).subspan(static_cast<std::size_t>(kTableOffset_bytes), table_bytes)));
    return start_table();
}

Status ObjectStream::State::start_table() {
    arrived.assign(table().size(), false);
    missing = table().size();
    for (std::size_t i = 0; i < table().size(); ++i) {
        const ChunkKind* const kind = find_chunk_kind(table()[i].name);
        if (kind == nullptr) {  // the reader skips it, or refuses the object
            arrived[i] = true;
            --missing;
        } else if (kind->stage <= ReadStage::maps) {
            ++missing_before[kind->stage == ReadStage::maps ? 1 : 0];
        }
    }
    for (std::size_t i = 0; i < table().size(); ++i) {
        if (!arrived[i] && table()[i].size_bytes == 0) RS_TRY(accept(i, {}));
    }
    return read_stages();
}

Status ObjectStream::State::accept(std::size_t entry, std::vector<std::byte> bytes) {
    RS_ASSIGN_OR_RETURN(waiting[entry], index.checked_payload(table()[entry], std::move(bytes)));
    arrived[entry] = true;
    --missing;
    const ReadStage stage = find_chunk_kind(table()[entry].name)->stage;
    if (stage > ReadStage::maps) return read_waiting();
    --missing_before[stage == ReadStage::maps ? 1 : 0];
    return read_stages();
}

// Reads geometry and maps when all their chunks are there, and then what has been waiting for them.
Status ObjectStream::State::read_stages() {
    if (has_maps || missing_before[0] > 0 || missing_before[1] > 0) return {};
    RS_TRY(reader.read_geometry());
    RS_TRY(reader.read_maps());
    RS_TRY(validate_object(reader.partial().object, file));
    has_maps = true;
    return read_waiting();
}

// Reads the images that have arrived. Shape maps take longer; in a file that arrives from its start they are read after
// the call that brought the first image, which can be shown before.
Status ObjectStream::State::read_waiting() {
    if (!has_maps) return {};
    for (auto each = waiting.begin(); each != waiting.end();) {
        const std::size_t entry = (each++)->first;  // reading removes the entry
        const bool is_shape = find_chunk_kind(table()[entry].name)->stage == ReadStage::shapes;
        if (!is_shape || reads_shapes) RS_TRY(read_late_chunk(entry));
        if (!is_shape) has_images = true;
    }
    return {};
}

Status ObjectStream::State::read_late_chunk(std::size_t entry) {
    const ChunkEntry& chunk = table()[entry];
    const ChunkKind& kind = *find_chunk_kind(chunk.name);
    const bool is_shape = kind.stage == ReadStage::shapes;
    RS_TRY(is_shape ? reader.read_shape(chunk.index) : reader.read_image(chunk.index));
    if (const Status valid = kind.validate(reader.partial().object, chunk.index); !valid) {
        return index.wrong("chunk " + to_string(chunk.name) + " " + std::to_string(chunk.index) + ": " +
                           valid.error().message);
    }
    (is_shape ? arrivals.shapes : arrivals.images).push_back(chunk.index);
    return {};
}

// Drops runs whose chunk has arrived from elsewhere.
void ObjectStream::State::forget_stale_runs() {
    if (table().empty()) return;
    std::erase_if(runs, [&](const auto& each) {
        const std::uint64_t begin = each.second.begin;
        const auto found =
            std::upper_bound(table().begin(), table().end(), begin,
                             [](std::uint64_t at, const ChunkEntry& entry) { return at < entry.offset_bytes; });
        return found == table().begin() || arrived[position(*std::prev(found))];
    });
}

ObjectStream::ObjectStream(std::string where, std::optional<std::uint64_t> size_bytes,
                           const ReadObjectOptions& options) {
    ReadObjectOptions all = options;
    all.decode = false;
    all.max_level = kProgressiveLevels - 1;
    state_ = std::make_unique<State>(std::move(where), size_bytes, all);
}

ObjectStream::ObjectStream(ObjectStream&&) noexcept = default;
ObjectStream& ObjectStream::operator=(ObjectStream&&) noexcept = default;
ObjectStream::~ObjectStream() = default;

Status ObjectStream::add(std::uint64_t offset, std::span<const std::byte> bytes) {
    if (state_->failure.ok()) state_->failure = state_->add(offset, bytes);
    return state_->failure;
}

Status ObjectStream::finish(std::uint64_t size_bytes) const {
    RS_TRY(state_->failure);
    if (!state_->has_header) {
        const auto run = state_->runs.find(size_bytes);
        const std::span<const std::byte> start =
            run == state_->runs.end() ? std::span<const std::byte>() : std::span(run->second.bytes);
        RS_TRY(ContainerIndex::from_header(start, size_bytes, state_->file));
        return {};
    }
    if (size_bytes != index().size_bytes()) return index().wrong_file_size(size_bytes);
    if (!is_complete()) return index().wrong("parts of it are missing; load it again");
    return {};
}

bool ObjectStream::has_table() const {
    return !state_->arrived.empty();
}

bool ObjectStream::has_maps() const {
    return state_->has_maps;
}

bool ObjectStream::is_complete() const {
    return has_maps() && state_->missing == 0 && state_->waiting.empty();
}

const RaySpaceObject& ObjectStream::object() const {
    RS_CHECK(has_maps());
    return state_->reader.partial().object;
}

ObjectStream::Arrivals ObjectStream::take_arrivals() {
    return std::exchange(state_->arrivals, {});
}

ShapeMap ObjectStream::take_shape(std::uint32_t ring) {
    return std::exchange(state_->reader.partial().object.rings[ring].shape, {});
}

RaySpaceObject ObjectStream::take_object() {
    RS_CHECK(is_complete());
    return std::move(state_->reader.partial().object);
}

const ContainerIndex& ObjectStream::index() const {
    return state_->index;
}

bool ObjectStream::has_arrived(std::size_t entry) const {
    return state_->arrived[entry];
}

std::uint64_t ObjectStream::arrived_from(std::uint64_t begin) const {
    for (const auto& [end, run] : state_->runs) {
        if (run.begin == begin) return end;
    }
    return begin;
}

}  // namespace rs
