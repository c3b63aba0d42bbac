#pragma once
// Reads the chunks of a file, to be changed and written again.

#include "rayspace/format/container.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

namespace rs::test {

struct Chunk {
    ChunkName name{};
    std::uint32_t index = 0;
    std::vector<std::byte> payload;
};
using Chunks = std::vector<Chunk>;

inline Chunks chunks_of(const std::filesystem::path& path) {
    Chunks chunks;
    const auto reader = ContainerReader::open(path);
    EXPECT_TRUE(reader.ok());
    for (const ChunkEntry& entry : reader->table()) {
        chunks.push_back({entry.name, entry.index, std::move(reader->read(entry)).value()});
    }
    return chunks;
}

inline void write_chunks(const std::filesystem::path& path, const Chunks& chunks) {
    auto writer = ContainerWriter::create(path, static_cast<std::uint32_t>(chunks.size()));
    ASSERT_TRUE(writer.ok());
    for (const Chunk& chunk : chunks) ASSERT_TRUE(writer->add(chunk.name, chunk.index, chunk.payload).ok());
    ASSERT_TRUE(writer->commit().ok());
}

}  // namespace rs::test
