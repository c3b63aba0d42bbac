#pragma once
// Makes well-formed containers in memory around arbitrary payloads, with an encoding of their own of the format's rules
// (encode/FORMAT.md): what the fuzzer feeds does not pass through the writer under test.

#include "rayspace/format/container.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rs::fuzz {

struct SoupChunk {
    ChunkName name{};
    std::uint32_t index = 0;
    std::vector<std::byte> payload;
};

// Input framing, repeated to the end: { u8 kind, u8 index, u16 length, length bytes }. kind % 11 chooses HEAD RIGJ
// VIEW RING RMAP PICT note NOTE shap CODE foot; a length beyond the end is cut there.
std::vector<SoupChunk> chunks_from_input(std::span<const std::uint8_t> input);
std::vector<std::uint8_t> input_from_chunks(std::span<const SoupChunk> chunks);

std::vector<std::byte> container_of(std::span<const SoupChunk> chunks);

// Overwrites file size, table checksum and header checksum so that they fit the bytes.
void seal(std::vector<std::byte>& container);

}  // namespace rs::fuzz
