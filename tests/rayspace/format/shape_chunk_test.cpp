#include "rayspace/format/chunks/shape_chunk.hpp"

#include "rayspace/format/content_coding.hpp"
#include "rayspace/format/object_file.hpp"
#include "tests/support/put_number.hpp"
#include "tests/support/small_shape.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>

namespace {

using namespace rs;
using namespace rs::object_chunks;
using test::small_object_with_shape;
using test::SmallShapeOptions;
using testing::HasSubstr;

constexpr std::size_t kSurfacesAt = 40;
constexpr std::size_t kCellBytesAt = 44;
constexpr std::size_t kGapsAt = 48;

Status parse(std::span<const std::byte> payload, Ring& ring) {
    const auto coded = parse_shape_head(payload, ring);
    if (!coded) return coded.error();
    return parse_shape_cells(*coded, ring.shape);
}

// Parses the payload and validates it as a reader does.
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

// Depths in random order, all values.
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

TEST(ShapeChunk, FieldsAreWhereTheFormatSays) {
    Ring ring = small_object_with_shape().rings[0];
    ring.shape.jump = 77;
    ring.shape.thickness = 99;
    const Payload payload = shape_payload(ring);
    EXPECT_EQ(payload.at(0), std::byte{2});
    EXPECT_EQ(payload.at(1), std::byte{77});
    EXPECT_EQ(payload.at(2), std::byte{99});
    EXPECT_EQ(payload.at(3), std::byte{0});
    const auto surfaces = std::count_if(ring.shape.cells.begin(), ring.shape.cells.end(),
                                        [](const ShapeCell& cell) { return cell.has_surface(); });
    EXPECT_EQ(number_at(payload, kSurfacesAt), static_cast<std::uint32_t>(surfaces));
    EXPECT_EQ(payload.size(), kGapsAt + 8 * 2 + 8 * 4 * 16 + number_at(payload, kCellBytesAt));
}

// A depth that deviates by at most the tolerance is replaced by its prediction, which the next predictions use.
TEST(ShapeChunk, DepthsSettleOnTheirPredictions) {
    const auto settled = [](int tolerance) {
        ShapeMap shape = small_object_with_shape({}, {.p_cells = 1, .bands = 6, .lines = {1, 0}}).rings[0].shape;
        std::fill(shape.cells.begin(), shape.cells.end(), ShapeCell{});
        constexpr int kDepths[] = {100, 101, 103, 102, 104};
        for (std::size_t i = 0; i < 5; ++i) shape.cells[i] = {static_cast<std::uint8_t>(kDepths[i]), 1};
        shape_coding::snap_depths(shape, tolerance);
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

// Without the checksum: accepted payloads are valid, and survive a round trip.
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
    EXPECT_THAT(number(kCellBytesAt, 0xFFFFFFFF, 4), HasSubstr("bytes long instead of"));
    EXPECT_THAT(number(kGapsAt, 3, 2), HasSubstr("cells with a surface, but has"));
}

// Any bytes decode to some cells; only the number of surfaces shows that they are wrong.
TEST(ShapeChunk, CellsMustBearOutTheCount) {
    const std::uint32_t count = number_at(shape_payload(small_object_with_shape().rings[0]), kSurfacesAt);
    EXPECT_EQ(error_after([&](Payload& payload) { test::put_number(payload, kSurfacesAt, count - 1, 4); }),
              "claims " + std::to_string(count - 1) + " cells with a surface, but has " + std::to_string(count));
    const std::string of_noise = error_after([](Payload& payload) {
        const std::size_t cells = payload.size() - number_at(payload, kCellBytesAt);
        for (std::size_t at = cells; at < payload.size(); ++at) payload[at] = std::byte{0x5A};
    });
    EXPECT_THAT(of_noise, HasSubstr("claims " + std::to_string(count) + " cells with a surface, but has "));
    EXPECT_THAT(error_after([](Payload& payload) {
                    payload.resize(payload.size() - number_at(payload, kCellBytesAt));
                    test::put_number(payload, kCellBytesAt, 0, 4);
                }),
                HasSubstr("cells with a surface, but has 0"));
}

}  // namespace
