#include "rayspace/format/object_file.hpp"

#include "rayspace/format/chunk_table.hpp"
#include "rayspace/format/object_reader.hpp"

#include <algorithm>

namespace rs {

using namespace object_chunks;

namespace {

class ContainerChunks final : public ChunkSource {
public:
    explicit ContainerChunks(const ContainerReader& container) : container_(container) {}
    [[nodiscard]] const std::string& where() const override { return container_.where(); }
    [[nodiscard]] std::span<const ChunkEntry> table() const override { return container_.table(); }
    [[nodiscard]] const ChunkEntry* find(ChunkName name, std::uint32_t index) const override {
        return container_.find(name, index);
    }
    Result<std::vector<std::byte>> read(const ChunkEntry& entry) override { return container_.read(entry); }

private:
    const ContainerReader& container_;
};

}  // namespace

Status write_object(const std::filesystem::path& path, const RaySpaceObject& object, Progress* progress) {
    RS_TRY(validate_object(object, path.string()));
    for (std::size_t i = 0; i < object.images.size(); ++i) {
        if (object.coded ? !object.coded->images[i].loaded() : object.images[i].empty()) {
            return Error{path.string() + ": image " + std::to_string(i) + " is not loaded; an object is written whole"};
        }
    }
    const std::vector<ChunkKey> order = chunk_order(object);
    RS_ASSIGN_OR_RETURN(auto writer, ContainerWriter::create(path, static_cast<std::uint32_t>(order.size())));
    if (progress != nullptr) progress->start("writing", static_cast<std::int64_t>(order.size()));
    for (const ChunkKey key : order) {
        RS_TRY(writer.add(key.name, key.index, chunk_payload(object, key)));
        if (progress != nullptr) progress->advance();
    }
    Status status = writer.commit();
    if (progress != nullptr) progress->finish();
    return status;
}

Result<RaySpaceObject> read_object(const ContainerReader& container, const ReadObjectOptions& options) {
    ContainerChunks chunks(container);
    return ObjectReader(chunks, options).read();
}

Result<RaySpaceObject> read_object(const std::filesystem::path& path, const ReadObjectOptions& options) {
    RS_ASSIGN_OR_RETURN(const auto container, ContainerReader::open(path));
    return read_object(container, options);
}

Result<ReadMemory> estimate_read_memory(const ContainerReader& container, const ReadObjectOptions& options) {
    ContainerChunks chunks(container);
    return ObjectReader(chunks, options).measure();
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

std::int64_t object_memory_bytes(const RaySpaceObject& object) {
    std::int64_t bytes = sizeof(RaySpaceObject);
    for (const object_chunks::ChunkKind& kind : object_chunks::chunk_table()) {
        if (kind.heap_bytes == nullptr) continue;
        for (std::uint32_t index = 0; index < max_chunk_count(kind.each, object); ++index)
            bytes += kind.heap_bytes(object, index);
    }
    return bytes;
}

}  // namespace rs
