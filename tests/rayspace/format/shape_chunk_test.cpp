#include "rayspace/format/shape_chunk.hpp"

#include "rayspace/format/object_file.hpp"
#include "rayspace/format/shape_validate.hpp"
#include "tests/support/put_number.hpp"
#include "tests/support/small_shape.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>

namespace {

using namespace rs;
using namespace rs::object_chunks;
using test::small_object_with_shape;
using test::SmallShapeOptions;
using testing::AnyOf;
using testing::HasSubstr;

constexpr std::size_t kSurfacesAt = 40;
constexpr std::size_t kFrameBytesAt = 44;
constexpr std::size_t kGapsAt = 52;

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
    for (std::size_t i = 0; i < which; ++i) begin += number_at(payload, kFrameBytesAt + 4 * i);
    const auto first = payload.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto place =
        payload.erase(first, first + static_cast<std::ptrdiff_t>(number_at(payload, kFrameBytesAt + 4 * which)));
    payload.insert(place, frame.begin(), frame.end());
    test::put_number(payload, kFrameBytesAt + 4 * which, frame.size(), 4);
}

Payload frame_number(const Payload& payload, std::size_t which) {
    std::size_t begin = frames_at();
    for (std::size_t i = 0; i < which; ++i) begin += number_at(payload, kFrameBytesAt + 4 * i);
    const auto first = payload.begin() + static_cast<std::ptrdiff_t>(begin);
    return {first, first + static_cast<std::ptrdiff_t>(number_at(payload, kFrameBytesAt + 4 * which))};
}

TEST(ShapeChunk, TheSmallShapeIsNotTrivial) {
    const ShapeMap shape = small_object_with_shape().rings[0].shape;
    ASSERT_EQ(shape.cells.size(), 8U * 2 * 9 * 7);
    std::set<int> depths;
    std::size_t empty = 0;
    for (const ShapeCell& cell : shape.cells) {
        if (cell.has_surface()) depths.insert(cell.depth);
        empty += cell.has_surface() ? 0 : 1;
    }
    EXPECT_GT(empty, 100U);
    EXPECT_GT(shape.cells.size() - empty, 300U);
    EXPECT_GT(depths.size(), 30U);
}

TEST(ShapeChunk, RoundTrip) {
    const SmallShapeOptions options[] = {
        {},
        {.p_cells = 1, .bands = 1, .lines = {1}},
        {.p_cells = 3, .bands = 5, .lines = {1, 0, 0}},  // cells that do not fill the last byte of bits
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

// Depths without any order, all values.
TEST(ShapeChunk, AnyCellsComeBack) {
    Ring ring = small_object_with_shape().rings[0];
    for (const unsigned seed : {1U, 2U, 3U}) {
        std::mt19937 random(seed);
        for (ShapeCell& cell : ring.shape.cells) {
            cell = {};
            if (random() % 4 == 0) continue;
            cell.depth = static_cast<std::uint8_t>(random());
            cell.shown = static_cast<std::uint8_t>(1 + random() % 3);
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
    ring.shape.cells[0] = {100, 3};
    ring.shape.cells[1] = {110, 1};
    ring.shape.cells[3] = {104, 2};
    ring.shape.cells[4] = {90, 3};
    ring.shape.jump = 77;
    ring.shape.thickness = 99;
    const Payload payload = shape_payload(ring);
    EXPECT_EQ(payload.at(0), std::byte{2});
    EXPECT_EQ(payload.at(1), std::byte{77});
    EXPECT_EQ(payload.at(2), std::byte{99});
    EXPECT_EQ(payload.at(3), std::byte{0});
    EXPECT_EQ(number_at(payload, kSurfacesAt), 4U);
    const auto plane = [&](std::size_t which, std::size_t size) {
        std::vector<std::uint8_t> bytes(size);
        const Payload frame = frame_number(payload, which);
        EXPECT_EQ(ZSTD_decompress(bytes.data(), size, frame.data(), frame.size()), size);
        return bytes;
    };
    EXPECT_EQ(plane(0, 3), (std::vector<std::uint8_t>{3 + 4 * 1 + 64 * 2, 3, 0}));
    // 128; below; line before; median of below 104, before 110 and 110 + 104 - 100 = 114.
    EXPECT_EQ(plane(1, 4), (std::vector<std::uint8_t>{256 - 28, 10, 4, 256 - 20}));
}

// A depth that is off by no more than the tolerance becomes what it is predicted to be, and the next ones are predicted
// from that.
TEST(ShapeChunk, DepthsSettleOnTheirPredictions) {
    const auto settled = [](int tolerance) {
        ShapeMap shape = small_object_with_shape({}, {.p_cells = 1, .bands = 6, .lines = {1, 0}}).rings[0].shape;
        std::fill(shape.cells.begin(), shape.cells.end(), ShapeCell{});
        constexpr int kDepths[] = {100, 101, 103, 102, 104};
        for (std::size_t i = 0; i < 5; ++i) shape.cells[i] = {static_cast<std::uint8_t>(kDepths[i]), 1};
        settle_depths(shape, tolerance);
        std::vector<int> depths;
        for (std::size_t i = 0; i < 6; ++i) depths.push_back(shape.cells[i].depth);
        return depths;
    };
    EXPECT_EQ(settled(0), (std::vector<int>{100, 101, 103, 102, 104, 0}));
    EXPECT_EQ(settled(1), (std::vector<int>{100, 100, 103, 103, 103, 0}));
    EXPECT_EQ(settled(2), (std::vector<int>{100, 100, 103, 103, 103, 0}));
    EXPECT_EQ(settled(3), (std::vector<int>{100, 100, 100, 100, 104, 0}));
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
        return error_after([&](Payload& payload) { test::put_number(payload, offset, value, size); });
    };
    EXPECT_EQ(error_after([](Payload&) {}), "read without error");
    EXPECT_EQ(error_after([](Payload& payload) { payload.clear(); }), "is empty");
    EXPECT_EQ(error_after([](Payload& payload) { payload.resize(kGapsAt - 1); }), "is too short");
    EXPECT_THAT(number(0, 3, 1), HasSubstr("has shape coding 3, which is not known here; update"));
    EXPECT_THAT(number(0, 1, 1),
                HasSubstr("has shape coding 1, of a file older than format 2.3; encode the capture set"));
    EXPECT_THAT(number(1, 0, 1), HasSubstr("its jump is not between 1 and 255"));
    EXPECT_EQ(number(1, 1, 1), "read without error");
    EXPECT_EQ(number(1, 255, 1), "read without error");
    EXPECT_EQ(number(2, 255, 1), "read without error");
    EXPECT_THAT(number(3, 1, 1), HasSubstr("reserved bytes"));
    EXPECT_THAT(number(4, 0, 2), HasSubstr("lines of 0x7 cells"));
    EXPECT_THAT(number(6, 4097, 2), HasSubstr("lines of 9x4097 cells; each side must be 1..4096"));
    EXPECT_THAT(number(kGapsAt, 1025, 2), HasSubstr("a gap has 1025 lines; 0..1024 are possible"));
    EXPECT_THAT(error_after([](Payload& payload) {
                    test::put_number(payload, 4, 4096, 2);
                    test::put_number(payload, 6, 4096, 2);
                }),
                HasSubstr("has 268435456 cells; at most 134217728 are possible"));
    EXPECT_THAT(number(kSurfacesAt, 1009, 4), HasSubstr("claims 1009 cells with a surface among 1008"));
    for (const std::size_t field : {0U, 1U}) {
        EXPECT_THAT(number(kFrameBytesAt + 4 * field, 0xFFFFFFFF, 4), HasSubstr("bytes long instead of")) << field;
    }
    EXPECT_THAT(number(kGapsAt, 3, 2),
                HasSubstr("what is shown of its cells do not state the 268 bytes that they must expand to"));
}

TEST(ShapeChunk, FramesAreExactlyWhatTheySay) {
    const Payload good = shape_payload(small_object_with_shape().rings[0]);
    const std::uint32_t surfaces = number_at(good, kSurfacesAt);
    const auto with = [](std::size_t which, const Payload& frame) {
        return error_after([&](Payload& payload) { replace_frame(payload, which, frame); });
    };
    EXPECT_EQ(with(1, frame_number(good, 1)), "read without error");
    EXPECT_THAT(with(0, {}), HasSubstr("what is shown of its cells are no Zstandard frame"));
    EXPECT_THAT(with(1, frame_of(std::vector<std::uint8_t>(surfaces + 1))), HasSubstr("its depths do not state the"));
    EXPECT_THAT(with(1, frame_of(std::vector<std::uint8_t>(surfaces - 1))), HasSubstr("its depths do not state the"));
    EXPECT_THAT(with(1, {}), HasSubstr("its depths are no Zstandard frame"));

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
    const std::vector<std::uint8_t> zeros(surfaces);
    Payload unstated(ZSTD_compressBound(zeros.size()));
    unstated.resize(ZSTD_compress2(context, unstated.data(), unstated.size(), zeros.data(), zeros.size()));
    ZSTD_freeCCtx(context);
    EXPECT_THAT(with(1, unstated), HasSubstr("do not state"));
    // A frame that states the right size and holds another: two bytes in a raw block behind a header that says
    // otherwise.
    Payload liar = frame_of(std::vector<std::uint8_t>(300));
    ASSERT_GE(surfaces, 256U);
    test::put_number(liar, 5, surfaces - 256, 2);  // Frame_Content_Size of two bytes, behind magic and descriptor
    EXPECT_THAT(with(1, liar), AnyOf(HasSubstr("cannot be decompressed"), HasSubstr("too few bytes")));
}

// The plane `which` of a small shape, changed; what the reader says then.
std::string error_with_plane(const SmallShapeOptions& options, std::size_t which,
                             const std::function<void(std::vector<std::uint8_t>&)>& change) {
    const Ring ring = small_object_with_shape({}, options).rings[0];
    Payload payload = shape_payload(ring);
    std::vector<std::uint8_t> plane(which == 0 ? (ring.shape.cells.size() + 3) / 4 : number_at(payload, kSurfacesAt));
    const Payload frame = frame_number(payload, which);
    EXPECT_EQ(ZSTD_decompress(plane.data(), plane.size(), frame.data(), frame.size()), plane.size());
    change(plane);
    replace_frame(payload, which, frame_of(plane));
    const auto back = read_back(payload, ring);
    return back.ok() ? std::string("read without error") : back.error().message;
}

TEST(ShapeChunk, BitsMustBearOutTheCount) {
    const auto with_flipped = [](std::size_t cell) {
        return error_with_plane({}, 0, [&](auto& plane) {
            plane.at(cell / 4) = static_cast<std::uint8_t>(plane.at(cell / 4) ^ 3U << 2 * (cell % 4));
        });
    };
    const Ring ring = small_object_with_shape().rings[0];
    const auto& cells = ring.shape.cells;
    const std::size_t count = number_at(shape_payload(ring), kSurfacesAt);
    const std::string claim = "claims " + std::to_string(count) + " cells with a surface, but its bits show ";
    const auto empty = std::find(cells.begin(), cells.end(), ShapeCell{});
    ASSERT_NE(empty, cells.end());
    EXPECT_EQ(with_flipped(static_cast<std::size_t>(empty - cells.begin())), claim + std::to_string(count + 1));
    const auto full = std::find_if(cells.begin(), cells.end(), [](const ShapeCell& c) { return c.has_surface(); });
    ASSERT_NE(full, cells.end());
    EXPECT_EQ(with_flipped(static_cast<std::size_t>(full - cells.begin())), claim + std::to_string(count - 1));
}

TEST(ShapeChunk, BitsBehindTheLastCellAreZero) {
    const SmallShapeOptions options{.p_cells = 3, .bands = 5, .lines = {1, 0, 0}};  // 45 cells: 6 bits are left
    ASSERT_EQ(small_object_with_shape({}, options).rings[0].shape.cells.size(), 45U);
    const auto with = [&](unsigned bits) {
        return error_with_plane(options, 0,
                                [&](auto& plane) { plane.back() = static_cast<std::uint8_t>(plane.back() | bits); });
    };
    EXPECT_EQ(with(0), "read without error");
    EXPECT_EQ(with(0x04), "has bits behind its last cell");
    EXPECT_EQ(with(0x80), "has bits behind its last cell");
}

}  // namespace
