#pragma once
// Makes well-formed containers in memory around arbitrary payloads. It implements the format (encode/FORMAT.md) itself,
// so that fuzzer input does not pass through the writer under test.

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

/// Parses the input framing, repeated to the end: { u8 kind, u8 index, u16 length, length bytes }. kind % 11 selects
/// HEAD RIGJ VIEW RING RMAP PICT note NOTE shap CODE foot; a length beyond the end is clipped.
std::vector<SoupChunk> chunks_from_input(std::span<const std::uint8_t> input);
std::vector<std::uint8_t> input_from_chunks(std::span<const SoupChunk> chunks);

std::vector<std::byte> container_of(std::span<const SoupChunk> chunks);

/// Overwrites file size, table checksum and header checksum to match the bytes.
void seal(std::vector<std::byte>& container);

}  // namespace rs::fuzz
