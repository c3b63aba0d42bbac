#pragma once
// Reads the chunks of one object, stage by stage (encode/FORMAT.md, "Reading"). read_object() runs all stages on a
// whole file; ObjectStream runs each as soon as its chunks have arrived.

#include "rayspace/format/chunks/chunk_kind.hpp"
#include "rayspace/format/object_file.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rs {

/// Table and payloads of a container.
class ChunkSource {
public:
    ChunkSource() = default;
    ChunkSource(const ChunkSource&) = delete;
    ChunkSource& operator=(const ChunkSource&) = delete;
    virtual ~ChunkSource() = default;
    [[nodiscard]] virtual const std::string& where() const = 0;
    [[nodiscard]] virtual std::span<const ChunkEntry> table() const = 0;
    [[nodiscard]] virtual const ChunkEntry* find(ChunkName name, std::uint32_t index) const = 0;
    /// Returns a verified payload.
    virtual Result<std::vector<std::byte>> read(const ChunkEntry& entry) = 0;
};

class ObjectReader {
public:
    ObjectReader(ChunkSource& chunks, const ReadObjectOptions& options) : chunks_(chunks), options_(options) {}

    /// All stages; the object has passed validate_object().
    Result<RaySpaceObject> read();
    /// Reads no large chunks. The memory of small ones is bounded by their size; the worst case is the parsed text of a
    /// rig.
    Result<ReadMemory> measure();

    /// Stages in their order. Only read() validates values.
    Status read_geometry();  // all chunks but those below; checks the order of the table and the memory
    Status read_maps();      // RMAP
    Status read_shapes();    // `shap`, of all rings
    /// Chunks of the last two stages, in any order.
    Status read_shape(std::uint32_t ring);
    Status read_image(std::uint32_t view);

    [[nodiscard]] object_chunks::PartialObject& partial() { return partial_; }

private:
    [[nodiscard]] std::uint64_t memory_of_geometry() const;
    [[nodiscard]] Error in_chunk(const object_chunks::ChunkKind& kind, std::uint32_t index, const Error& error) const;
    Result<std::vector<std::byte>> read_payload(const ChunkEntry& entry);
    Status read_chunk(const object_chunks::ChunkKind& kind, std::uint32_t index);
    Status read_stage(object_chunks::ReadStage stage);
    Status read_each(object_chunks::ChunkScope each, object_chunks::ReadStage stage, std::uint32_t index);
    Status read_images();
    [[nodiscard]] Status check_chunks() const;
    Status check_memory();
    [[nodiscard]] std::uint64_t wanted_images() const;
    [[nodiscard]] bool is_wanted(const Ring& ring, std::size_t n) const;
    [[nodiscard]] std::uint64_t image_bytes() const;
    [[nodiscard]] std::uint64_t coded_planes_bytes() const;
    [[nodiscard]] Error too_large(std::uint64_t needed_bytes) const;

    ChunkSource& chunks_;
    ReadObjectOptions options_;
    object_chunks::PartialObject partial_;
    std::uint64_t needed_bytes_ = 0;  // counted against memory_cap_bytes
};

}  // namespace rs
