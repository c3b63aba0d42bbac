#include "rayspace/format/object_file.hpp"

#include "rayspace/base/zstd_frame.hpp"
#include "rayspace/format/content_coding.hpp"
#include "rayspace/format/object_chunks.hpp"
#include "tests/rayspace/format/file_chunks.hpp"
#include "tests/support/put_number.hpp"
#include "tests/support/small_object.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <set>

namespace {

using namespace rs;
using test::Chunk;
using test::Chunks;
using test::chunks_of;
using test::small_object;
using test::SmallObjectOptions;
using test::TemporaryFolder;
using test::write_chunks;
using testing::HasSubstr;

void expect_same(const RaySpaceObject& a, const RaySpaceObject& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.units_per_radius, b.units_per_radius);
    EXPECT_EQ(a.foot_q20, b.foot_q20);
    EXPECT_EQ(a.rig_json, b.rig_json);
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.views, b.views);
    EXPECT_EQ(a.rings, b.rings);
    EXPECT_EQ(a.images, b.images);
}

Chunk& find(Chunks& chunks, const char* name, std::uint32_t index = 0) {
    for (Chunk& chunk : chunks) {
        if (to_string(chunk.name) == name && chunk.index == index) return chunk;
    }
    ADD_FAILURE() << "no chunk " << name;
    return chunks.front();
}

void put_number(Chunk& chunk, std::size_t offset, std::uint64_t number, std::size_t size) {
    test::put_number(chunk.payload, offset, number, size);
}

// The error from reading a small object's file after `change`.
std::string error_after(const std::function<void(Chunks&)>& change, const ReadObjectOptions& options = {}) {
    const TemporaryFolder folder;
    EXPECT_TRUE(write_object(folder / "a.rso", small_object()).ok());
    Chunks chunks = chunks_of(folder / "a.rso");
    change(chunks);
    write_chunks(folder / "b.rso", chunks);
    const auto object = read_object(folder / "b.rso", options);
    if (object.ok()) return "read without error";
    EXPECT_EQ(object.error().message.find('\n'), std::string::npos);
    EXPECT_THAT(object.error().message, HasSubstr((folder / "b.rso").string()));
    return object.error().message;
}

TEST(ObjectFile, RoundTrip) {
    SmallObjectOptions several_rings;
    several_rings.rings = 3;
    several_rings.width = 7;  // odd: chroma is rounded up
    several_rings.height = 9;
    SmallObjectOptions finest;
    finest.planes = kMaxPlanes;
    finest.u_cells = kMaxMapSide;
    finest.x_cells = 1;
    SmallObjectOptions fewest;
    fewest.views_per_ring = 3;
    fewest.planes = kMinPlanes;
    fewest.width = 1;
    fewest.height = 1;
    fewest.u_cells = 1;
    for (const SmallObjectOptions& options : {SmallObjectOptions{}, several_rings, finest, fewest}) {
        const TemporaryFolder folder;
        const RaySpaceObject object = small_object(options);
        const Status written = write_object(folder / "a.rso", object);
        ASSERT_TRUE(written.ok()) << written.error().message;
        const auto back = read_object(folder / "a.rso");
        ASSERT_TRUE(back.ok()) << back.error().message;
        expect_same(*back, object);
    }
}

TEST(ObjectFile, TheSameObjectGivesTheSameBytes) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_object(folder / "a.rso", small_object()).ok());
    ASSERT_TRUE(write_object(folder / "b.rso", small_object()).ok());
    EXPECT_EQ(*read_file(folder / "a.rso", 1 << 20), *read_file(folder / "b.rso", 1 << 20));
}

TEST(ObjectFile, TheFootIsKeptWhereItIsKnown) {
    const TemporaryFolder folder;
    RaySpaceObject object = small_object();
    object.foot_q20 = -123456;
    ASSERT_TRUE(write_object(folder / "standing.rso", object).ok());
    const auto back = read_object(folder / "standing.rso");
    ASSERT_TRUE(back.ok()) << back.error().message;
    expect_same(*back, object);
    object.foot_q20 = 1 << 28;
    const Status far = write_object(folder / "far.rso", object);
    ASSERT_FALSE(far.ok());
    EXPECT_THAT(far.error().message, HasSubstr("its foot is 256 object radii or more"));
}

TEST(ObjectFile, TheAxisOfARingIsKept) {
    const TemporaryFolder folder;
    RaySpaceObject object = small_object();
    object.rings.front().rotation = {1 << 29, 1 << 29, 1 << 29, 1 << 29};
    ASSERT_TRUE(write_object(folder / "turned.rso", object).ok());
    const auto back = read_object(folder / "turned.rso");
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(back->rings, object.rings);
    object.rings.front().rotation.w_q30 += 1 << 20;
    const Status longer = write_object(folder / "longer.rso", object);
    ASSERT_FALSE(longer.ok());
    EXPECT_THAT(longer.error().message, HasSubstr("its rotation is not a unit quaternion"));
}

TEST(ObjectFile, AnObjectMayHaveNoRig) {
    const TemporaryFolder folder;
    RaySpaceObject object = small_object();
    object.rig_json.clear();
    ASSERT_TRUE(write_object(folder / "a.rso", object).ok());
    const auto back = read_object(folder / "a.rso");
    ASSERT_TRUE(back.ok()) << back.error().message;
    expect_same(*back, object);
}

TEST(ObjectFile, LevelsAreLoadedOneByOne) {
    const TemporaryFolder folder;
    SmallObjectOptions options;
    options.rings = 2;
    options.views_per_ring = 20;
    const RaySpaceObject object = small_object(options);
    ASSERT_TRUE(write_object(folder / "a.rso", object).ok());
    const int expected[] = {2 * 3, 2 * 5, 2 * 10, 2 * 20};
    for (int level = 0; level < kProgressiveLevels; ++level) {
        ReadObjectOptions read_options;
        read_options.max_level = level;
        const auto back = read_object(folder / "a.rso", read_options);
        ASSERT_TRUE(back.ok()) << back.error().message;
        int loaded = 0;
        for (std::size_t i = 0; i < back->images.size(); ++i) {
            if (back->images[i].empty()) continue;
            EXPECT_EQ(back->images[i], object.images[i]);
            EXPECT_LE(progressive_level(static_cast<int>(i % 20)), level);
            ++loaded;
        }
        EXPECT_EQ(loaded, expected[level]);
        EXPECT_EQ(back->rings, object.rings);
    }
}

TEST(ObjectFile, ImagesStandInProgressiveOrder) {
    const TemporaryFolder folder;
    SmallObjectOptions options;
    options.rings = 2;
    options.views_per_ring = 9;
    ASSERT_TRUE(write_object(folder / "a.rso", small_object(options)).ok());
    std::vector<std::uint32_t> order;
    for (const Chunk& chunk : chunks_of(folder / "a.rso")) {
        if (to_string(chunk.name) == "PICT") order.push_back(chunk.index);
    }
    EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 8, 9, 17, 4, 13, 2, 6, 11, 15, 1, 3, 5, 7, 10, 12, 14, 16}));
}

TEST(ObjectFile, APartlyLoadedObjectIsNotWritten) {
    const TemporaryFolder folder;
    RaySpaceObject object = small_object();
    object.images[3] = {};
    const Status status = write_object(folder / "a.rso", object);
    ASSERT_FALSE(status.ok());
    EXPECT_THAT(status.error().message, HasSubstr("image 3 is not loaded"));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ObjectFile, AncillaryChunksAreSkippedAndCriticalOnesAreNot) {
    const auto with = [](const ChunkName& name, bool front) {
        return [=](Chunks& chunks) { chunks.insert(front ? chunks.begin() : chunks.end(), {name, 7, {std::byte{1}}}); };
    };
    EXPECT_EQ(error_after(with({'n', 'o', 't', 'e'}, true)), "read without error");
    EXPECT_EQ(error_after(with({'n', 'o', 't', 'e'}, false)), "read without error");
    EXPECT_THAT(error_after(with({'N', 'O', 'T', 'E'}, false)), HasSubstr("NOTE 7 is unknown"));
}

TEST(ObjectFile, ChunksMustBeThereAndInOrder) {
    for (const char* name : {"HEAD", "RIGJ", "VIEW", "RING", "RMAP", "PICT"}) {
        EXPECT_THAT(error_after([&](Chunks& chunks) {
                        std::erase_if(chunks,
                                      [&](const Chunk& c) { return to_string(c.name) == name && c.index == 0; });
                    }),
                    testing::AnyOf(HasSubstr("has no chunk"), HasSubstr("out of place")))
            << name;
    }
    EXPECT_THAT(error_after([](Chunks& chunks) { std::swap(chunks[0], chunks[1]); }), HasSubstr("out of place"));
    EXPECT_THAT(error_after([](Chunks& chunks) { std::swap(chunks[chunks.size() - 1], chunks[chunks.size() - 2]); }),
                HasSubstr("out of place"));
    EXPECT_THAT(error_after([](Chunks& chunks) { chunks.back().index = 8; }), HasSubstr("out of place"));
    EXPECT_THAT(error_after([](Chunks& chunks) { chunks.pop_back(); }), HasSubstr("has no chunk PICT 7"));
}

TEST(ObjectFile, NumbersAreCheckedBeforeTheyAllocate) {
    const auto head = [](std::size_t offset, std::uint64_t number, std::size_t size) {
        return error_after([&](Chunks& chunks) { put_number(find(chunks, "HEAD"), offset, number, size); });
    };
    EXPECT_THAT(head(0, 0, 4), HasSubstr("chunk HEAD 0: the images' width is 0; it must be 1..8192"));
    EXPECT_THAT(head(4, 8193, 4), HasSubstr("the images' height is 8193"));
    EXPECT_THAT(head(8, 0xFFFFFFFF, 4), HasSubstr("the number of views is 4294967295"));
    EXPECT_THAT(head(12, 65, 4), HasSubstr("the number of rings is 65"));
    EXPECT_THAT(head(16, 0x7FF0000000000000, 8), HasSubstr("units per radius"));
    EXPECT_THAT(head(24, 256, 4), HasSubstr("the name's length is 256"));
    EXPECT_THAT(head(24, 4, 4), HasSubstr("bytes long instead of"));
    EXPECT_THAT(head(28, 0x0A, 1), HasSubstr("name"));
    EXPECT_THAT(head(8, 9, 4), HasSubstr("chunk VIEW 0: is 128 bytes long instead of 144"));

    const auto ring = [](std::size_t offset, std::uint64_t number, std::size_t size) {
        return error_after([&](Chunks& chunks) { put_number(find(chunks, "RING"), offset, number, size); });
    };
    EXPECT_THAT(ring(4, 2, 2), HasSubstr("chunk RING 0: the number of planes is 2; it must be 3..64"));
    EXPECT_THAT(ring(6, 9, 2), HasSubstr("the number of views is 9"));
    EXPECT_THAT(ring(5, 2, 1), HasSubstr("line coding 2, which is not known here"));
    EXPECT_THAT(ring(5, 0, 1), HasSubstr("bytes of lines instead of 512"));
    EXPECT_THAT(ring(6, 7, 2), HasSubstr("its lines are no Zstandard frame"));
    EXPECT_THAT(error_after([](Chunks& chunks) { find(chunks, "RING").payload.resize(28 + 15); }),
                HasSubstr("ends inside of its list of views"));
    EXPECT_THAT(ring(8, 4097, 2), HasSubstr("size along x is 4097"));
    EXPECT_THAT(ring(10, 0, 2), HasSubstr("size along u is 0"));
    EXPECT_THAT(ring(28, 8, 2), HasSubstr("a view's number is 8"));
    EXPECT_THAT(ring(28, 1, 2), HasSubstr("names view 1 a second time"));

    const auto map = [](const std::function<void(map_coding::Runs&)>& change) {
        return error_after([&](Chunks& chunks) {
            const Ring small = small_object().rings[0];
            map_coding::Runs runs = map_coding::encode_runs(small.cells, small.u_cells);
            change(runs);
            find(chunks, "RMAP").payload = object_chunks::map_payload(runs);
        });
    };
    EXPECT_THAT(map([](map_coding::Runs& r) { r.counts[0] = 0; }), HasSubstr("row 0 fills 0 cells instead of 16"));
    EXPECT_THAT(map([](map_coding::Runs& r) { r.counts[0] = 0xFFFF; }),
                HasSubstr("RMAP 0: row 0 has more runs than there are"));
    EXPECT_THAT(map([](map_coding::Runs& r) { r.lengths[0] = 0; }),
                HasSubstr("row 0 has a run of 0 cells where 1..16 fit"));
    EXPECT_THAT(map([](map_coding::Runs& r) { r.lengths[0] = 17; }), HasSubstr("row 0 has a run of 17 cells"));
    EXPECT_THAT(map([](map_coding::Runs& r) { r.views[0] = 8; }),
                HasSubstr("names view 8, which is not one of the ring's"));
    EXPECT_THAT(map([](map_coding::Runs& r) {
                    r.views.push_back(0);
                    r.lengths.push_back(1);
                }),
                HasSubstr("has runs behind its last row"));
    const auto map_bytes = [](std::size_t bytes) {
        return error_after([&](Chunks& chunks) { find(chunks, "RMAP").payload.resize(bytes); });
    };
    EXPECT_THAT(map_bytes(3), HasSubstr("RMAP 0: ends inside its number of runs"));
    EXPECT_THAT(map_bytes(4), HasSubstr("RMAP 0: its runs are no Zstandard frame"));
    EXPECT_THAT(error_after([](Chunks& chunks) { put_number(find(chunks, "RMAP"), 0, 63, 4); }),
                HasSubstr("the number of runs is 63; it must be 64..1024"));
    EXPECT_THAT(error_after([](Chunks& chunks) { put_number(find(chunks, "RMAP"), 0, 1025, 4); }),
                HasSubstr("the number of runs is 1025; it must be 64..1024"));

    const auto image = [](std::size_t offset, std::uint64_t number) {
        return error_after([&](Chunks& chunks) { put_number(find(chunks, "PICT", 5), offset, number, 1); });
    };
    EXPECT_THAT(image(0, 1), HasSubstr("chunk PICT 5: has image coding 1, which is not known here; update"));
    EXPECT_THAT(image(15, 1), HasSubstr("reserved bytes"));
    EXPECT_THAT(error_after([](Chunks& chunks) { find(chunks, "PICT", 5).payload.pop_back(); }),
                HasSubstr("is 315 bytes long instead of 316"));
    EXPECT_THAT(error_after([](Chunks& chunks) { find(chunks, "PICT", 5).payload.clear(); }), HasSubstr("is empty"));
    EXPECT_THAT(error_after([](Chunks& chunks) { find(chunks, "RIGJ").payload.resize(100); }),
                HasSubstr("the words of its rig are not one whole Zstandard frame"));
}

TEST(ObjectFile, RigsMayBeTextOrFrames) {
    const auto rig = [](std::string text) {
        return error_after([&](Chunks& chunks) {
            const auto bytes = std::as_bytes(std::span(text));
            find(chunks, "RIGJ").payload.assign(bytes.begin(), bytes.end());
        });
    };
    const auto frame = [](const std::string& text) {
        const auto bytes = compress_zstd({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    const std::string text = test::small_object().rig_json;
    ASSERT_FALSE(text.empty());
    EXPECT_EQ(rig(text), "read without error");
    EXPECT_EQ(rig(frame(text)), "read without error");
    EXPECT_LT(frame(text).size(), text.size());
    EXPECT_THAT(rig(text.substr(0, 100)), HasSubstr("rig: is not valid JSON"));
    EXPECT_THAT(rig(frame("{")), HasSubstr("rig: is not valid JSON"));
    EXPECT_THAT(rig(frame(text) + " "), HasSubstr("are not one whole Zstandard frame"));
    EXPECT_THAT(rig(frame(std::string((std::size_t{16} << 20) + 1, ' '))),
                HasSubstr("the rig's length, expanded, is 16777217; it must be 0..16777216"));
}

TEST(ObjectFile, MemoryIsCapped) {
    ReadObjectOptions options;
    options.memory_cap_bytes = 2000;
    // The map takes 2048 bytes, each image 300; the map's runs are in memory twice during decompression.
    const Ring small = small_object().rings[0];
    const std::uint64_t runs = map_coding::encode_runs(small.cells, small.u_cells).views.size();
    const std::uint64_t expanding = 2 * map_coding::residual_bytes(64, runs);
    EXPECT_THAT(error_after([](Chunks& chunks) { find(chunks, "RIGJ").payload.clear(); }, options),
                HasSubstr("needs 1 MiB of memory, more than"));
    options.memory_cap_bytes = 2048 + 8 * 300 + expanding;
    EXPECT_EQ(error_after([](Chunks& chunks) { find(chunks, "RIGJ").payload.clear(); }, options), "read without error");
    options.memory_cap_bytes -= 1;
    EXPECT_THAT(error_after([](Chunks& chunks) { find(chunks, "RIGJ").payload.clear(); }, options),
                HasSubstr("memory"));
    options.max_level = 0;
    options.memory_cap_bytes = 2048 + 300 + expanding;
    EXPECT_EQ(error_after([](Chunks& chunks) { find(chunks, "RIGJ").payload.clear(); }, options), "read without error");
}

TEST(ObjectFile, UnwantedImagesAreNotTouched) {
    ReadObjectOptions options;
    options.max_level = 0;
    EXPECT_EQ(error_after([](Chunks& chunks) { find(chunks, "PICT", 1).payload.clear(); }, options),
              "read without error");
}

TEST(ObjectFile, SummaryCountsChunksByName) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_object(folder / "a.rso", small_object()).ok());
    const auto reader = ContainerReader::open(folder / "a.rso");
    ASSERT_TRUE(reader.ok());
    const auto summary = summarise_chunks(*reader);
    ASSERT_EQ(summary.size(), 6U);
    EXPECT_EQ(summary[0].name, "HEAD");
    EXPECT_EQ(summary[5].name, "PICT");
    EXPECT_EQ(summary[5].count, 8U);
    EXPECT_EQ(summary[5].size_bytes, 8U * (16 + 300));
}

TEST(ObjectFile, ProgressGoesToItsEnd) {
    struct Counting final : Progress {
        std::int64_t total = 0, done = 0;
        bool finished = false;
        void start(const std::string&, std::int64_t steps) override { total = steps; }
        void advance(std::int64_t steps) override { done += steps; }
        void finish() override { finished = true; }
    } progress;
    const TemporaryFolder folder;
    ASSERT_TRUE(write_object(folder / "a.rso", small_object(), &progress).ok());
    EXPECT_EQ(progress.done, 5 + 8);
    EXPECT_EQ(progress.total, progress.done);
    EXPECT_TRUE(progress.finished);
}

}  // namespace
