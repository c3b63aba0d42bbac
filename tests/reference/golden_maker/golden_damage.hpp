#pragma once
// Modifications that turn a valid file into an invalid one, each violating one rule of encode/FORMAT.md, and the texts
// that the error must contain. Checksums are corrected afterwards, so that only this rule is violated.

#include "rayspace/format/object_chunks.hpp"
#include "tests/fuzz/chunk_soup.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace rs::golden {

using Bytes = std::vector<std::byte>;
using Chunks = std::vector<fuzz::SoupChunk>;

/// A file being modified: its chunks, then changes of the final bytes.
struct Draft {
    Chunks chunks;
    std::function<void(Bytes&)> afterwards;

    /// The payload of an existing chunk.
    Bytes& payload(ChunkName name, std::uint32_t index = 0);
    std::size_t place(ChunkName name, std::uint32_t index = 0) const;
};

struct Damage {
    std::string name;
    std::string base;   // a valid file's name
    std::string words;  // texts in the error, separated by " | "
    std::function<void(Draft&)> apply;
    bool is_of_codec = false;  // concerns the payload of CODE or of a coded PICT
};

void set_number(Bytes& bytes, std::size_t offset, std::int64_t value, std::size_t size);
std::int64_t number_at(const Bytes& bytes, std::size_t offset, std::size_t size);  // unsigned

/// Stores `value` in `size` bytes at `offset` of a payload.
Damage number_damage(std::string name, std::string base, ChunkName chunk, std::uint32_t index, std::size_t offset,
                     std::size_t size, std::int64_t value, std::string words);

/// A Zstandard frame of the content; `states_size`: as required by the format.
Bytes frame_of(const Bytes& content, bool has_checksum, bool states_size);
Bytes content_of(const Bytes& frame);
Bytes fewer(const Bytes& frame);  // a frame of its content without the last byte

std::vector<Damage> container_damages();
std::vector<Damage> order_damages();
std::vector<Damage> geometry_damages();
std::vector<Damage> shape_damages();
/// Modifications of the valid files "dense-random-small", "dense-random-masks-small" and "board-random-small", whose
/// chunks determine the offsets.
std::vector<Damage> code_damages(const Draft& dense, const Draft& masks, const Draft& board);
std::vector<Damage> image_damages(const std::string& base, const Draft& valid);

}  // namespace rs::golden
