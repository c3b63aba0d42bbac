#include "rayspace/shape_chunk.hpp"

#include "rayspace/object_file.hpp"
#include "rayspace/shape_validate.hpp"
#include "tests/support/small_shape.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <functional>
#include <random>

namespace {

using namespace rs;
using namespace rs::object_chunks;
using test::small_object_with_shape;
using test::SmallShapeOptions;
using testing::AnyOf;
using testing::HasSubstr;

constexpr std::size_t kLayer0CellsAt = 40;
constexpr std::size_t kLayer1CellsAt = 44;
constexpr std::size_t kRaysBytesAt = 48;
constexpr std::size_t kGapsAt = 64;

// 8 views and 4 planes, as small_object() has.
std::size_t frames_at() {
    return kGapsAt + 8 * 2 + 8 * 4 * 16;
}

Status parse(std::span<const std::byte> payload, Ring& ring) {
    const auto coded = parse_shape_head(payload, ring);
    if (!coded) return coded.error();
    return parse_shape_cells(*coded, ring.shape);
}

// What the payload says, checked as a reader checks it.
Result<ShapeMap> read_back(std::span<const std::byte> payload, Ring ring) {
    ring.shape = {};
    if (const Status status = parse(payload, ring); !status) return status.error();
    if (const Status status = check_shape(ring); !status) return status.error();
    return ring.shape;
}

void put_number(Payload& payload, std::size_t offset, std::uint64_t number, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) payload.at(offset + i) = static_cast<std::byte>(number >> (8 * i));
}

std::uint32_t number_at(const Payload& payload, std::size_t offset) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i) number |= static_cast<std::uint32_t>(payload.at(offset + i)) << (8 * i);
    return number;
}

std::string error_after(const std::function<void(Payload&)>& change) {
    const Ring ring = small_object_with_shape().rings[0];
    Payload payload = shape_payload(ring);
    change(payload);
    const auto back = read_back(payload, ring);
    return back.ok() ? "read without error" : back.error().message;
}

Payload frame_of(const std::vector<std::uint8_t>& plane) {
    Payload frame(ZSTD_compressBound(plane.size()));
    frame.resize(ZSTD_compress(frame.data(), frame.size(), plane.data(), plane.size(), 3));
    return frame;
}

// Puts `frame` in the place of frame number `which`.
void replace_frame(Payload& payload, std::size_t which, const Payload& frame) {
    std::size_t begin = frames_at();
    for (std::size_t i = 0; i < which; ++i) begin += number_at(payload, kRaysBytesAt + 4 * i);
    const auto first = payload.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto place =
        payload.erase(first, first + static_cast<std::ptrdiff_t>(number_at(payload, kRaysBytesAt + 4 * which)));
    payload.insert(place, frame.begin(), frame.end());
    put_number(payload, kRaysBytesAt + 4 * which, frame.size(), 4);
}

Payload frame_number(const Payload& payload, std::size_t which) {
    std::size_t begin = frames_at();
    for (std::size_t i = 0; i < which; ++i) begin += number_at(payload, kRaysBytesAt + 4 * i);
    const auto first = payload.begin() + static_cast<std::ptrdiff_t>(begin);
    return {first, first + static_cast<std::ptrdiff_t>(number_at(payload, kRaysBytesAt + 4 * which))};
}

TEST(ShapeChunk, TheSmallShapeIsNotTrivial) {
    const ShapeMap shape = small_object_with_shape().rings[0].shape;
    ASSERT_EQ(shape.cells.size(), 8U * 2 * 9 * 7);
    int with[16] = {};
    for (const ShapeCell& cell : shape.cells) ++with[cell.rays];
    for (const int rays : {0, 1, 2, 3, 3 | 4, 3 | 8}) EXPECT_GT(with[rays], 10) << rays;
}

TEST(ShapeChunk, RoundTrip) {
    const SmallShapeOptions options[] = {
        {},
        {.p_cells = 1, .bands = 1, .lines = {1}},
        {.p_cells = 3, .bands = 5, .lines = {1, 0, 0}},  // an odd number of cells
        {.p_cells = 40, .bands = 30, .lines = {3, 1}},
        {.p_cells = 2, .bands = 2, .lines = {0}},  // no cells at all
    };
    for (const SmallShapeOptions& each : options) {
        const Ring ring = small_object_with_shape({}, each).rings[0];
        const auto back = read_back(shape_payload(ring), ring);
        ASSERT_TRUE(back.ok()) << back.error().message;
        EXPECT_EQ(*back, ring.shape);
    }
}

// Depths without any order, all values, all combinations of layers.
TEST(ShapeChunk, AnyCellsComeBack) {
    Ring ring = small_object_with_shape().rings[0];
    for (const unsigned seed : {1U, 2U, 3U}) {
        std::mt19937 random(seed);
        for (ShapeCell& cell : ring.shape.cells) {
            const auto rays = static_cast<unsigned>(random() % 16);
            cell.rays = static_cast<std::uint8_t>((rays & 3U) == 0 ? 0 : rays);
            cell.depth[0] = (cell.rays & 3) == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(random());
            cell.back = (cell.rays & 3) == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(random());
            cell.depth[1] = (cell.rays & 12) == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(random());
        }
        const auto back = read_back(shape_payload(ring), ring);
        ASSERT_TRUE(back.ok()) << back.error().message;
        EXPECT_EQ(*back, ring.shape);
    }
}

// The sums of FORMAT.md, section "Planes", by hand: line 0 has cells a and b, one above the other, and nothing else.
TEST(ShapeChunk, PlanesAreAsTheFormatSays) {
    Ring ring = small_object_with_shape({}, {.p_cells = 1, .bands = 3, .lines = {1, 0}}).rings[0];
    ASSERT_EQ(ring.shape.cells.size(), 12U);
    std::fill(ring.shape.cells.begin(), ring.shape.cells.end(), ShapeCell{});
    ring.shape.cells[0] = {{100, 130}, 140, 1 | 4};
    ring.shape.cells[1] = {{110, 0}, 151, 3};
    ring.shape.cells[3] = {{104, 0}, 104, 2};
    ring.shape.cells[4] = {{117, 0}, 90, 3};
    const Payload payload = shape_payload(ring);
    EXPECT_EQ(number_at(payload, kLayer0CellsAt), 4U);
    EXPECT_EQ(number_at(payload, kLayer1CellsAt), 1U);
    const auto plane = [&](std::size_t which, std::size_t size) {
        std::vector<std::uint8_t> bytes(size);
        const Payload frame = frame_number(payload, which);
        EXPECT_EQ(ZSTD_decompress(bytes.data(), size, frame.data(), frame.size()), size);
        return bytes;
    };
    EXPECT_EQ(plane(0, 6), (std::vector<std::uint8_t>{0x35, 0x20, 0x03, 0, 0, 0}));
    // 128; below; line before; median of below 104, before 110 and 110 + 104 - 100.
    EXPECT_EQ(plane(1, 4), (std::vector<std::uint8_t>{256 - 28, 10, 4, 7}));
    EXPECT_EQ(plane(2, 1), (std::vector<std::uint8_t>{130 - 128}));
    // 128; below 140; before 140; of below 104, before 151 and 151 + 104 - 140 = 115 the median.
    EXPECT_EQ(plane(3, 4), (std::vector<std::uint8_t>{140 - 128, 11, 256 - 36, 256 - 25}));
}

TEST(ShapeChunk, TheSameMapGivesTheSameBytes) {
    EXPECT_EQ(shape_payload(small_object_with_shape().rings[0]), shape_payload(small_object_with_shape().rings[0]));
}

TEST(ShapeChunk, ASmoothMapIsSmall) {
    const Ring ring = small_object_with_shape({}, {.p_cells = 64, .bands = 48, .lines = {3}}).rings[0];
    EXPECT_LT(shape_payload(ring).size(), ring.shape.cells.size() / 3);
}

TEST(ShapeChunk, EveryTruncationIsRejected) {
    const Ring ring = small_object_with_shape().rings[0];
    const Payload payload = shape_payload(ring);
    for (std::size_t size = 0; size < payload.size(); ++size) {
        EXPECT_FALSE(read_back(std::span(payload).first(size), ring).ok()) << size;
    }
    Payload longer = payload;
    longer.push_back(std::byte{0});
    EXPECT_THAT(read_back(longer, ring).error().message, HasSubstr("bytes long instead of"));
}

// Behind the checksum: what is accepted is valid, and comes back from its own payload.
TEST(ShapeChunk, EveryBitFlipIsRejectedOrGivesAValidMap) {
    const Ring ring = small_object_with_shape().rings[0];
    const Payload payload = shape_payload(ring);
    int rejected = 0;
    for (std::size_t i = 0; i < payload.size(); ++i) {
        for (const unsigned bits : {0x01U, 0x10U, 0x80U, 0xFFU}) {
            Payload flipped = payload;
            flipped[i] ^= static_cast<std::byte>(bits);
            const auto back = read_back(flipped, ring);
            rejected += back.ok() ? 0 : 1;
            if (!back) continue;
            Ring changed = ring;
            changed.shape = *back;
            const auto again = read_back(shape_payload(changed), ring);
            ASSERT_TRUE(again.ok()) << again.error().message;
            EXPECT_EQ(*again, *back) << i;
        }
    }
    EXPECT_GT(rejected, 300);
}

TEST(ShapeChunk, FieldsAreCheckedBeforeTheyAllocate) {
    const auto number = [](std::size_t offset, std::uint64_t value, std::size_t size) {
        return error_after([&](Payload& payload) { put_number(payload, offset, value, size); });
    };
    EXPECT_EQ(error_after([](Payload&) {}), "read without error");
    EXPECT_EQ(error_after([](Payload& payload) { payload.clear(); }), "is empty");
    EXPECT_EQ(error_after([](Payload& payload) { payload.resize(kGapsAt - 1); }), "is too short");
    EXPECT_THAT(number(0, 1, 1), HasSubstr("has shape coding 1, which is not known here; update"));
    EXPECT_THAT(number(3, 1, 1), HasSubstr("reserved bytes"));
    EXPECT_THAT(number(4, 0, 2), HasSubstr("lines of 0x7 cells"));
    EXPECT_THAT(number(6, 4097, 2), HasSubstr("lines of 9x4097 cells; each side must be 1..4096"));
    EXPECT_THAT(number(kGapsAt, 1025, 2), HasSubstr("a gap has 1025 lines; 0..1024 are possible"));
    EXPECT_THAT(error_after([](Payload& payload) {
                    put_number(payload, 4, 4096, 2);
                    put_number(payload, 6, 4096, 2);
                }),
                HasSubstr("has 268435456 cells; at most 134217728 are possible"));
    EXPECT_THAT(number(kLayer0CellsAt, 1009, 4), HasSubstr("claims 1009 cells with layer 0"));
    EXPECT_THAT(number(kLayer1CellsAt, 1000, 4), HasSubstr("1000 with layer 1 among 1008"));
    for (const std::size_t field : {0U, 1U, 2U, 3U}) {
        EXPECT_THAT(number(kRaysBytesAt + 4 * field, 0xFFFFFFFF, 4), HasSubstr("bytes long instead of")) << field;
    }
    EXPECT_THAT(number(kGapsAt, 3, 2), HasSubstr("its rays do not state the 536 bytes that they must expand to"));
}

TEST(ShapeChunk, FramesAreExactlyWhatTheySay) {
    const Payload good = shape_payload(small_object_with_shape().rings[0]);
    const std::uint32_t layer0 = number_at(good, kLayer0CellsAt);
    const std::uint32_t layer1 = number_at(good, kLayer1CellsAt);
    const auto with = [](std::size_t which, const Payload& frame) {
        return error_after([&](Payload& payload) { replace_frame(payload, which, frame); });
    };
    EXPECT_EQ(with(1, frame_number(good, 1)), "read without error");
    EXPECT_THAT(with(0, {}), HasSubstr("its rays are no Zstandard frame"));
    EXPECT_THAT(with(1, frame_of(std::vector<std::uint8_t>(layer0 + 1))),
                HasSubstr("its depths of layer 0 do not state the"));
    EXPECT_THAT(with(2, frame_of(std::vector<std::uint8_t>(layer1 - 1))),
                HasSubstr("its depths of layer 1 do not state the"));
    EXPECT_THAT(with(3, {}), HasSubstr("its backs are no Zstandard frame"));

    // A second frame, a skippable one in front, one cut short, one without its size.
    Payload two = frame_number(good, 1);
    const Payload none = frame_of({});
    two.insert(two.end(), none.begin(), none.end());
    EXPECT_THAT(with(1, two), HasSubstr("not one whole Zstandard frame"));
    Payload skippable = {std::byte{0x50}, std::byte{0x2A}, std::byte{0x4D}, std::byte{0x18}, {}, {}, {}, {}};
    const Payload second = frame_number(good, 1);
    skippable.insert(skippable.end(), second.begin(), second.end());
    EXPECT_THAT(with(1, skippable), HasSubstr("are no Zstandard frame"));
    Payload cut = frame_number(good, 1);
    cut.pop_back();
    EXPECT_THAT(with(1, cut), HasSubstr("not one whole Zstandard frame"));
    ZSTD_CCtx* const context = ZSTD_createCCtx();
    ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, 0);
    const std::vector<std::uint8_t> zeros(layer0);
    Payload unstated(ZSTD_compressBound(zeros.size()));
    unstated.resize(ZSTD_compress2(context, unstated.data(), unstated.size(), zeros.data(), zeros.size()));
    ZSTD_freeCCtx(context);
    EXPECT_THAT(with(1, unstated), HasSubstr("do not state"));
    // A frame that states the right size and holds another: two bytes in a raw block behind a header that says layer0.
    Payload liar = frame_of(std::vector<std::uint8_t>(300));
    ASSERT_GE(layer0, 256U);
    put_number(liar, 5, layer0 - 256, 2);  // Frame_Content_Size of two bytes, behind magic and descriptor
    EXPECT_THAT(with(1, liar), AnyOf(HasSubstr("cannot be decompressed"), HasSubstr("too few bytes")));
}

TEST(ShapeChunk, RaysMustBearOutTheCounts) {
    const auto with_rays = [](std::size_t byte, std::uint8_t value, bool odd = false) {
        const SmallShapeOptions options =
            odd ? SmallShapeOptions{.p_cells = 3, .bands = 5, .lines = {1, 0, 0}} : SmallShapeOptions{};
        const Ring ring = small_object_with_shape({}, options).rings[0];
        Payload payload = shape_payload(ring);
        std::vector<std::uint8_t> plane((ring.shape.cells.size() + 1) / 2);
        const Payload frame = frame_number(payload, 0);
        EXPECT_EQ(ZSTD_decompress(plane.data(), plane.size(), frame.data(), frame.size()), plane.size());
        plane.at(std::min(byte, plane.size() - 1)) ^= value;
        replace_frame(payload, 0, frame_of(plane));
        const auto back = read_back(payload, ring);
        return back.ok() ? std::string("read without error") : back.error().message;
    };
    const Ring ring = small_object_with_shape().rings[0];
    const auto empty = std::find(ring.shape.cells.begin(), ring.shape.cells.end(), ShapeCell{});
    ASSERT_NE(empty, ring.shape.cells.end());
    const auto place = static_cast<std::size_t>(empty - ring.shape.cells.begin());
    const unsigned shift = place % 2 * 4;
    EXPECT_THAT(with_rays(place / 2, static_cast<std::uint8_t>(1U << shift)), HasSubstr("with layer 0, but its rays"));
    EXPECT_THAT(with_rays(place / 2, static_cast<std::uint8_t>(4U << shift)), HasSubstr("with layer 1, but its rays"));
    EXPECT_EQ(ring.shape.cells.size() % 2, 0U);
    EXPECT_EQ(with_rays(1000, 0x10, true), "has ray bits behind its last cell");
    EXPECT_EQ(with_rays(1000, 0x80, true), "has ray bits behind its last cell");
}

}  // namespace
