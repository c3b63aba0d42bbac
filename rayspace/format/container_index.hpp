#pragma once
// Header and table of an .rso container, parsed from the first bytes of a file of which the rest may be missing. Used
// by ContainerReader, which has the whole file, and ObjectStream, whose file is still arriving. encode/FORMAT.md,
// section "Container".

#include "rayspace/base/result.hpp"
#include "rayspace/format/container.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rs {

class ContainerIndex {
public:
    /// Checks the header.
    /// \param start       the first 48 bytes, or all bytes of a shorter file
    /// \param size_bytes  size of the file; nullopt if it is unknown: then the header's is used
    /// \param where       names the file in errors
    static Result<ContainerIndex> from_header(std::span<const std::byte> start, std::optional<std::uint64_t> size_bytes,
                                              std::string where);
    /// Checks the table: the bytes behind the header, up to end_bytes().
    Status read_table(std::span<const std::byte> bytes);

    /// End of the table in the file.
    [[nodiscard]] std::uint64_t end_bytes() const;
    [[nodiscard]] std::uint64_t size_bytes() const { return size_bytes_; }
    [[nodiscard]] const std::string& where() const { return where_; }
    [[nodiscard]] std::span<const ChunkEntry> table() const { return table_; }
    [[nodiscard]] const ChunkEntry* find(ChunkName name, std::uint32_t index) const;

    /// Verifies padding and checksum of a chunk. \param bytes  the payload with its padding
    /// \return the payload
    [[nodiscard]] Result<std::vector<std::byte>> checked_payload(const ChunkEntry& entry,
                                                                 std::vector<std::byte> bytes) const;
    /// "FILE: rest". `rest` states what is wrong.
    [[nodiscard]] Error wrong(const std::string& rest) const { return Error{where_ + ": " + rest}; }
    /// Error for a file of `size_bytes` that the header states otherwise.
    [[nodiscard]] Error wrong_file_size(std::uint64_t size_bytes) const;

private:
    [[nodiscard]] Status check_entries() const;
    Status index_by_name();

    std::string where_;
    std::uint64_t size_bytes_ = 0;
    std::uint32_t chunk_count_ = 0;
    std::uint64_t table_checksum_ = 0;
    std::vector<ChunkEntry> table_;
    std::vector<std::uint32_t> by_name_;  // positions in the table, sorted by (name, index)
};

}  // namespace rs
