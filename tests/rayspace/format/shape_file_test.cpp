// Files with a shape map: the chunk's position, the memory limit, and checksums.
#include "rayspace/format/chunks/shape_chunk.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/rayspace/format/file_chunks.hpp"
#include "tests/support/small_shape.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace {

using namespace rs;
using test::Chunk;
using test::Chunks;
using test::small_object;
using test::small_object_with_shape;
using test::SmallObjectOptions;
using test::TemporaryFolder;
using testing::HasSubstr;

Chunks chunks_of(const RaySpaceObject& object) {
    const TemporaryFolder folder;
    EXPECT_TRUE(write_object(folder / "a.rso", object).ok());
    return test::chunks_of(folder / "a.rso");
}

Result<RaySpaceObject> object_of(const Chunks& chunks, const ReadObjectOptions& options = {}) {
    const TemporaryFolder folder;
    test::write_chunks(folder / "b.rso", chunks);
    return read_object(folder / "b.rso", options);
}

std::string names_of(const Chunks& chunks) {
    std::string names;
    for (const Chunk& chunk : chunks) {
        if (to_string(chunk.name) != "PICT") names += to_string(chunk.name) + std::to_string(chunk.index) + " ";
    }
    return names;
}

Chunks::iterator shape_in(Chunks& chunks) {
    return std::find_if(chunks.begin(), chunks.end(), [](const Chunk& c) { return c.name == object_chunks::kShape; });
}

std::string shape_error_after(const std::function<void(Chunks&)>& change, const ReadObjectOptions& options = {}) {
    Chunks chunks = chunks_of(small_object_with_shape());
    change(chunks);
    const auto object = object_of(chunks, options);
    return object.ok() ? "read without error" : object.error().message;
}

RaySpaceObject three_rings_two_shapes() {
    SmallObjectOptions options;
    options.rings = 3;
    RaySpaceObject object = small_object_with_shape(options);
    object.rings[1].shape = {};
    return object;
}

TEST(ShapeFile, StandsBehindTheMapOfItsRing) {
    EXPECT_EQ(names_of(chunks_of(three_rings_two_shapes())),
              "HEAD0 RIGJ0 VIEW0 RING0 RMAP0 shap0 RING1 RMAP1 RING2 RMAP2 shap2 ");
    EXPECT_EQ(names_of(chunks_of(small_object())), "HEAD0 RIGJ0 VIEW0 RING0 RMAP0 ");
}

TEST(ShapeFile, ComesBackAtEveryLevel) {
    const RaySpaceObject object = three_rings_two_shapes();
    const Chunks chunks = chunks_of(object);
    for (int level = 0; level < kProgressiveLevels; ++level) {
        ReadObjectOptions options;
        options.max_level = level;
        const auto back = object_of(chunks, options);
        ASSERT_TRUE(back.ok()) << back.error().message;
        EXPECT_EQ(back->rings, object.rings);
        EXPECT_TRUE(back->rings[1].shape.empty());
    }
}

// Readers without support for the chunk skip it and read a complete object.
TEST(ShapeFile, WithoutItTheObjectIsThePapers) {
    Chunks chunks = chunks_of(small_object_with_shape());
    chunks.erase(shape_in(chunks));
    EXPECT_EQ(names_of(chunks), names_of(chunks_of(small_object())));
    const auto back = object_of(chunks);
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(back->rings, small_object().rings);
}

TEST(ShapeFile, TheSameObjectGivesTheSameBytes) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_object(folder / "a.rso", small_object_with_shape()).ok());
    ASSERT_TRUE(write_object(folder / "b.rso", small_object_with_shape()).ok());
    EXPECT_EQ(*read_file(folder / "a.rso", 1 << 20), *read_file(folder / "b.rso", 1 << 20));
}

TEST(ShapeFile, ItsPlaceIsChecked) {
    EXPECT_EQ(shape_error_after([](Chunks&) {}), "read without error");
    // Another ancillary chunk in between is skipped.
    EXPECT_EQ(shape_error_after([](Chunks& chunks) {
                  chunks.insert(shape_in(chunks), {{'n', 'o', 't', 'e'}, 0, {}});
              }),
              "read without error");
    EXPECT_THAT(
        shape_error_after([](Chunks& chunks) { std::rotate(shape_in(chunks), shape_in(chunks) + 1, chunks.end()); }),
        HasSubstr("out of place, where chunk shap 0 should stand"));
    EXPECT_THAT(
        shape_error_after([](Chunks& chunks) { std::rotate(chunks.begin(), shape_in(chunks), shape_in(chunks) + 1); }),
        HasSubstr("out of place"));
    EXPECT_THAT(shape_error_after([](Chunks& chunks) { shape_in(chunks)->index = 1; }),
                HasSubstr("chunk shap 1 is unknown or out of place"));
    Chunks chunks = chunks_of(three_rings_two_shapes());
    shape_in(chunks)->index = 1;
    EXPECT_THAT(object_of(chunks).error().message, HasSubstr("out of place"));
}

TEST(ShapeFile, APresentChunkMustBeRight) {
    const auto with_number = [](std::size_t offset, unsigned value) {
        ReadObjectOptions coarse;
        coarse.max_level = 0;
        return shape_error_after([&](Chunks& c) { shape_in(c)->payload.at(offset) = static_cast<std::byte>(value); },
                                 coarse);
    };
    EXPECT_THAT(with_number(0, 9), HasSubstr("chunk shap 0: has shape coding 9"));
    EXPECT_THAT(with_number(1, 0), HasSubstr("ring 0: its shape map: its jump"));
    EXPECT_THAT(with_number(3, 1), HasSubstr("chunk shap 0: has reserved bytes"));
    EXPECT_THAT(with_number(39, 1), HasSubstr("ring 0: its shape map: its depth step"));
    EXPECT_THAT(shape_error_after([](Chunks& chunks) { shape_in(chunks)->payload.clear(); }),
                HasSubstr("chunk shap 0: is empty"));
}

TEST(ShapeFile, EveryBitOfTheChunkIsCovered) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_object(folder / "a.rso", small_object_with_shape()).ok());
    const auto reader = ContainerReader::open(folder / "a.rso");
    ASSERT_TRUE(reader.ok());
    const ChunkEntry* const entry = reader->find(object_chunks::kShape, 0);
    ASSERT_NE(entry, nullptr);
    const auto file = *read_file(folder / "a.rso", 1 << 20);
    ReadObjectOptions options;
    options.max_level = 0;
    for (std::uint64_t i = 0; i < (entry->size_bytes + 15) / 16 * 16; ++i) {
        auto changed = file;
        changed[static_cast<std::size_t>(entry->offset_bytes + i)] ^= std::byte{0x10};
        const auto container = ContainerReader::over(std::move(changed), "F");
        ASSERT_TRUE(container.ok());
        EXPECT_FALSE(read_object(*container, options).ok()) << i;
    }
}

TEST(ShapeFile, MemoryIsCapped) {
    const std::size_t cells = small_object_with_shape().rings[0].shape.cells.size();
    const auto without_rig = [](Chunks& chunks) { chunks[1].payload.clear(); };
    ReadObjectOptions options;
    options.memory_cap_bytes = 2048 + 8 * 300 + 2 * cells;
    EXPECT_EQ(shape_error_after(without_rig, options), "read without error");
    options.memory_cap_bytes -= 1;
    EXPECT_THAT(shape_error_after(without_rig, options), HasSubstr("of memory, more than"));
}

// Millions of cells in a payload of a few hundred bytes are rejected before decompression.
TEST(ShapeFile, ASmallChunkCannotAskForMuchMemory) {
    RaySpaceObject object = small_object_with_shape();
    ShapeMap& shape = object.rings[0].shape;
    shape.p_cells = 1024;
    shape.bands = 512;
    shape.p_cells_per_unit_q12 = static_cast<std::int32_t>(4096 * 1024 / (2 * 1.02));
    shape.cells.assign(std::size_t{16} * 1024 * 512, ShapeCell{});
    const Chunks chunks = chunks_of(object);
    ReadObjectOptions options;
    options.memory_cap_bytes = std::uint64_t{8} << 20;
    const auto refused = object_of(chunks, options);
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().message, HasSubstr("needs 17 MiB of memory, more than the 8 MiB allowed"));
    options.memory_cap_bytes = std::uint64_t{18} << 20;
    const auto back = object_of(chunks, options);
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(back->rings, object.rings);
}

TEST(ShapeFile, SummaryListsIt) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_object(folder / "a.rso", three_rings_two_shapes()).ok());
    const auto reader = ContainerReader::open(folder / "a.rso");
    ASSERT_TRUE(reader.ok());
    const auto summary = summarise_chunks(*reader);
    const auto found = std::find_if(summary.begin(), summary.end(), [](const auto& s) { return s.name == "shap"; });
    ASSERT_NE(found, summary.end());
    EXPECT_EQ(found->count, 2U);
    EXPECT_EQ(found->size_bytes,
              reader->find(object_chunks::kShape, 0)->size_bytes + reader->find(object_chunks::kShape, 2)->size_bytes);
}

TEST(ShapeFile, AnInvalidMapIsNotWritten) {
    const TemporaryFolder folder;
    RaySpaceObject object = small_object_with_shape();
    object.rings[0].shape.cells.pop_back();
    const Status status = write_object(folder / "a.rso", object);
    ASSERT_FALSE(status.ok());
    EXPECT_THAT(status.error().message, HasSubstr("ring 0: its shape map: it does not have as many cells"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
