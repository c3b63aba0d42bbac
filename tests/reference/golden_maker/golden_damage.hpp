#pragma once
// Damages that make an invalid file of a valid one, each against one rule of encode/FORMAT.md, and the words that a
// refusal must contain. Checksums are made to fit afterwards, so that nothing but the rule is broken.

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

// A file on the way to being damaged: its chunks, then what happens to the finished bytes.
struct Draft {
    Chunks chunks;
    std::function<void(Bytes&)> afterwards;

    // A chunk that must be there.
    Bytes& payload(ChunkName name, std::uint32_t index = 0);
    std::size_t place(ChunkName name, std::uint32_t index = 0) const;
};

struct Damage {
    std::string name;
    std::string base;   // a valid file's name
    std::string words;  // in the refusal, separated by " | "
    std::function<void(Draft&)> apply;
    bool is_of_codec = false;  // of the payload of CODE or of a coded PICT
};

void set_number(Bytes& bytes, std::size_t offset, std::int64_t value, std::size_t size);
std::int64_t number_at(const Bytes& bytes, std::size_t offset, std::size_t size);  // unsigned

// `value` in `size` bytes at `offset` of a payload.
Damage number_damage(std::string name, std::string base, ChunkName chunk, std::uint32_t index, std::size_t offset,
                     std::size_t size, std::int64_t value, std::string words);

// A Zstandard frame of the content; `states_size`: as the format wants it.
Bytes frame_of(const Bytes& content, bool has_checksum, bool states_size);
Bytes content_of(const Bytes& frame);
Bytes fewer(const Bytes& frame);  // a frame of its content but for the last byte

std::vector<Damage> container_damages();
std::vector<Damage> order_damages();
std::vector<Damage> geometry_damages();
std::vector<Damage> shape_damages();
// Of the valid files "dense-random-small", "dense-random-masks-small" and "board-random-small", whose chunks tell where
// their numbers stand.
std::vector<Damage> code_damages(const Draft& dense, const Draft& masks, const Draft& board);
std::vector<Damage> image_damages(const std::string& base, const Draft& valid);

}  // namespace rs::golden
