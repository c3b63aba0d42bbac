#include "tests/fuzz/chunk_soup.hpp"

#include "rayspace/api/types/check.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace rs::fuzz {
namespace {

constexpr std::array<ChunkName, 11> kNames = {{{'H', 'E', 'A', 'D'},
                                               {'R', 'I', 'G', 'J'},
                                               {'V', 'I', 'E', 'W'},
                                               {'R', 'I', 'N', 'G'},
                                               {'R', 'M', 'A', 'P'},
                                               {'P', 'I', 'C', 'T'},
                                               {'n', 'o', 't', 'e'},
                                               {'N', 'O', 'T', 'E'},
                                               {'s', 'h', 'a', 'p'},
                                               {'C', 'O', 'D', 'E'},
                                               {'f', 'o', 'o', 't'}}};
constexpr std::size_t kHeader_bytes = 48;
constexpr std::size_t kEntry_bytes = 32;

void put(std::vector<std::byte>& bytes, std::size_t offset, std::uint64_t number, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) bytes[offset + i] = static_cast<std::byte>(number >> (8 * i));
}

}  // namespace

std::vector<SoupChunk> chunks_from_input(std::span<const std::uint8_t> input) {
    std::vector<SoupChunk> chunks;
    while (input.size() >= 4) {
        const std::size_t stated = input[2] + std::size_t{256} * input[3];
        const std::size_t length = std::min(stated, input.size() - 4);
        const auto payload = std::as_bytes(input.subspan(4, length));
        chunks.push_back({kNames[input[0] % kNames.size()], input[1], {payload.begin(), payload.end()}});
        input = input.subspan(4 + length);
    }
    return chunks;
}

std::vector<std::uint8_t> input_from_chunks(std::span<const SoupChunk> chunks) {
    std::vector<std::uint8_t> input;
    for (const SoupChunk& chunk : chunks) {
        const auto kind = std::find(kNames.begin(), kNames.end(), chunk.name);
        RS_CHECK(kind != kNames.end() && chunk.index < 256 && chunk.payload.size() < 65536);
        input.push_back(static_cast<std::uint8_t>(kind - kNames.begin()));
        input.push_back(static_cast<std::uint8_t>(chunk.index));
        input.push_back(static_cast<std::uint8_t>(chunk.payload.size() & 0xFFU));
        input.push_back(static_cast<std::uint8_t>(chunk.payload.size() >> 8U));
        for (const std::byte b : chunk.payload) input.push_back(static_cast<std::uint8_t>(b));
    }
    return input;
}

std::vector<std::byte> container_of(std::span<const SoupChunk> chunks) {
    static constexpr std::array<unsigned char, 8> kMagic = {0x89, 'R', 'S', 'O', '\r', '\n', 0x1A, '\n'};
    std::vector<std::byte> bytes(kHeader_bytes + kEntry_bytes * chunks.size());
    std::memcpy(bytes.data(), kMagic.data(), kMagic.size());
    put(bytes, 8, 2, 2);
    put(bytes, 12, chunks.size(), 4);
    put(bytes, 16, kHeader_bytes, 8);
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        const SoupChunk& chunk = chunks[i];
        const std::size_t entry = kHeader_bytes + kEntry_bytes * i;
        std::memcpy(bytes.data() + entry, chunk.name.data(), 4);
        put(bytes, entry + 4, chunk.index, 4);
        put(bytes, entry + 8, bytes.size(), 8);
        put(bytes, entry + 16, chunk.payload.size(), 8);
        put(bytes, entry + 24, XXH64(chunk.payload.data(), chunk.payload.size(), 0), 8);
        bytes.insert(bytes.end(), chunk.payload.begin(), chunk.payload.end());
        bytes.resize((bytes.size() + 15) / 16 * 16);
    }
    seal(bytes);
    return bytes;
}

void seal(std::vector<std::byte>& container) {
    if (container.size() < kHeader_bytes) return;
    std::uint32_t chunks = 0;
    std::memcpy(&chunks, container.data() + 12, sizeof chunks);
    const std::size_t table_bytes = std::min(kEntry_bytes * chunks, container.size() - kHeader_bytes);
    put(container, 24, container.size(), 8);
    put(container, 32, XXH64(container.data() + kHeader_bytes, table_bytes, 0), 8);
    put(container, 40, XXH64(container.data(), 40, 0), 8);
}

}  // namespace rs::fuzz
