#pragma once
// The .rso container: a table of checksummed chunks. Layout, field by field: encode/FORMAT.md, section "Container". The
// meaning of chunks is defined in object_file.hpp.

#include "rayspace/base/result.hpp"
#include "rayspace/file/file_output.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace rs {

/// ASCII letters and digits, starting with a letter, e.g. {'P','I','C','T'}. Readers skip unknown names that start with
/// a lower-case letter, and reject files with other unknown names.
using ChunkName = std::array<char, 4>;

struct ChunkEntry {
    ChunkName name{};
    std::uint32_t index = 0;         // distinguishes chunks of one name: image or ring number
    std::uint64_t offset_bytes = 0;  // from the start of the file
    std::uint64_t size_bytes = 0;
    std::uint64_t checksum = 0;  // XXH64, seed 0, of the payload
};

inline constexpr std::uint32_t kMaxChunks = 65536;
inline constexpr std::uint64_t kMaxChunk_bytes = std::uint64_t{1} << 30;
inline constexpr std::uint64_t kMaxContainer_bytes = std::uint64_t{1} << 36;

/// Writes chunks in the order of add() calls. Space for the table is reserved at the start, so the number of chunks is
/// fixed in advance. The file at `path` appears with commit().
class ContainerWriter {
public:
    static Result<ContainerWriter> create(const std::filesystem::path& path, std::uint32_t chunk_count);
    /// (name, index) must be unique.
    Status add(ChunkName name, std::uint32_t index, std::span<const std::byte> payload);
    /// All chunks must have been added.
    Status commit();

private:
    ContainerWriter(StagedFile file, std::uint32_t chunk_count);
    StagedFile file_;
    std::uint32_t chunk_count_;
    std::vector<ChunkEntry> table_;
};

/// Checks the header and the table when opened; payloads are read and checked one by one on demand, so that memory is
/// needed only for the chunks read. read() is thread-safe.
class ContainerReader {
public:
    static Result<ContainerReader> open(const std::filesystem::path& path);
    /// Opens a container in memory; `where` names it in errors.
    static Result<ContainerReader> over(std::vector<std::byte> bytes, std::string where);

    [[nodiscard]] std::span<const ChunkEntry> table() const;
    [[nodiscard]] const ChunkEntry* find(ChunkName name, std::uint32_t index) const;
    /// Reads a payload and verifies its checksum and padding. `entry` is one of table().
    [[nodiscard]] Result<std::vector<std::byte>> read(const ChunkEntry& entry) const;
    [[nodiscard]] const std::string& where() const;  // the file's name, for messages
    [[nodiscard]] std::uint64_t size_bytes() const;

    struct Source;

private:
    explicit ContainerReader(std::shared_ptr<const Source> source);
    static Result<ContainerReader> open_source(std::shared_ptr<Source> source);
    std::shared_ptr<const Source> source_;
};

std::string to_string(ChunkName name);

}  // namespace rs
