// Chunk shap: the library's parser and the one written from encode/FORMAT.md accept the same payloads and read the same
// values.

#include "tests/reference/decoder/reference_shape.hpp"
#include "rayspace/format/chunks/shape_chunk.hpp"
#include "rayspace/format/container.hpp"
#include "rayspace/format/content_coding.hpp"
#include "tests/support/random_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <random>

namespace rs::reference {
namespace {

namespace fs = std::filesystem;
using Payload = std::vector<std::byte>;

constexpr std::size_t kSurfacesAt = 40;
constexpr std::size_t kCellBytesAt = 44;

std::span<const std::uint8_t> numbers_of(const Payload& payload) {
    return {reinterpret_cast<const std::uint8_t*>(payload.data()), payload.size()};
}

void put_number(Payload& payload, std::size_t offset, std::uint64_t number, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) payload.at(offset + i) = static_cast<std::byte>(number >> (8 * i));
}

std::size_t u32_at(const Payload& payload, std::size_t at) {
    std::size_t number = 0;
    for (std::size_t i = 0; i < 4; ++i) number |= static_cast<std::size_t>(payload.at(at + i)) << (8 * i);
    return number;
}

// The library's result; nullopt if it rejects the payload.
std::optional<ShapeMap> library_shape(const Payload& payload, Ring ring) {
    ring.shape = {};
    const auto coded = object_chunks::parse_shape_head(payload, ring);
    if (!coded || !object_chunks::parse_shape_cells(*coded, ring.shape).ok() ||
        !object_chunks::check_shape(ring).ok()) {
        return std::nullopt;
    }
    return ring.shape;
}

void expect_same(const Shape& reference, const ShapeMap& library) {
    EXPECT_EQ(reference.jump, library.jump);
    EXPECT_EQ(reference.thickness, library.thickness);
    EXPECT_EQ(reference.p_cells, library.p_cells);
    EXPECT_EQ(reference.bands, library.bands);
    EXPECT_EQ(reference.numbers, (std::array<std::int32_t, 8>{
                                     library.p_half_q20, library.p_cells_per_unit_q12, library.h_low_q20,
                                     library.bands_per_unit_q12, library.reference_distance_q20,
                                     library.reference_height_q20, library.depth_low_q20, library.depth_step_q24}));
    ASSERT_EQ(reference.lines.size(), library.gaps.size());
    std::uint32_t first_line = 0;
    for (std::size_t n = 0; n < library.gaps.size(); ++n) {
        EXPECT_EQ(reference.lines[n], library.gaps[n].lines);
        EXPECT_EQ(first_line, library.gaps[n].first_line);
        first_line += library.gaps[n].lines;
    }
    ASSERT_EQ(reference.normal.size(), library.normal_lines.size());
    for (std::size_t i = 0; i < library.normal_lines.size(); ++i) {
        const NormalLine& line = library.normal_lines[i];
        EXPECT_EQ(reference.normal[i], (std::array<std::int32_t, 4>{line.l2_q30, line.q2_q16, line.a_q20, line.c_q20}));
    }
    ASSERT_EQ(reference.surfaces.size(), library.cells.size());
    for (std::size_t i = 0; i < library.cells.size(); ++i) {
        const ShapeSurface surface = reference.surfaces[i].value_or(ShapeSurface{});
        ASSERT_EQ(reference.surfaces[i].has_value(), library.cells[i].has_surface()) << i;
        ASSERT_EQ(surface.depth, library.cells[i].depth) << i;
        ASSERT_EQ(surface.shown, library.cells[i].shown) << i;
    }
}

struct Tally {
    int accepted = 0;
    int refused = 0;
};

void judge(const Payload& payload, const Ring& ring, Tally& tally) {
    Shape shape;
    const std::string error = read_shape(numbers_of(payload), static_cast<int>(ring.views.size()), ring.planes, shape);
    const auto by_library = library_shape(payload, ring);
    ASSERT_EQ(error.empty(), by_library.has_value()) << error;
    if (by_library) expect_same(shape, *by_library);
    ++(by_library ? tally.accepted : tally.refused);
}

// An object with the smallest shape map that has gaps with and without lines.
RaySpaceObject small_shaped() {
    test::SmallObjectOptions options;
    options.views_per_ring = 3;
    options.planes = 3;
    return test::small_object_with_shape(options, {.p_cells = 5, .bands = 3, .lines = {2, 0, 1}});
}

TEST(ReferenceShape, RandomMapsAreReadTheSame) {
    constexpr std::uint64_t kSeed = 5;
    SCOPED_TRACE(kSeed);
    std::mt19937_64 random(kSeed);
    RaySpaceObject object = test::small_object();
    Tally tally;
    std::size_t surfaces = 0;
    for (int i = 0; i < 60 && !testing::Test::HasFatalFailure(); ++i) {
        SCOPED_TRACE(i);
        Ring& ring = object.rings[0];
        ring.shape = test::random_shape(object, 0, random, i % 6 * 0.2);
        const Payload payload = object_chunks::shape_payload(ring);
        surfaces += u32_at(payload, kSurfacesAt);
        judge(payload, ring, tally);
    }
    EXPECT_EQ(tally.refused, 0);
    EXPECT_EQ(tally.accepted, 60);
    EXPECT_GT(surfaces, 50000U);
}

TEST(ReferenceShape, DamagedFieldsAreJudgedTheSame) {
    const Ring ring = small_shaped().rings[0];
    const Payload payload = object_chunks::shape_payload(ring);
    Tally tally;
    for (std::size_t at = 0; at < payload.size() && !testing::Test::HasFatalFailure(); ++at) {
        SCOPED_TRACE(at);
        for (const unsigned bits : {0x01U, 0x02U, 0x04U, 0x10U, 0x40U, 0x80U, 0xFFU}) {
            Payload damaged = payload;
            damaged[at] ^= static_cast<std::byte>(bits);
            judge(damaged, ring, tally);
        }
    }
    for (std::size_t size = 0; size < payload.size(); ++size) {
        judge({payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(size)}, ring, tally);
    }
    std::cout << tally.accepted << " accepted, " << tally.refused << " refused\n";
    EXPECT_GT(tally.accepted, 300);
    EXPECT_GT(tally.refused, 500);
}

// Each bound of the numbers, and the values beside it.
TEST(ReferenceShape, BoundsAreJudgedTheSame) {
    const Ring ring = small_shaped().rings[0];
    const Payload payload = object_chunks::shape_payload(ring);
    const std::size_t normal_at = 48 + 2 * ring.views.size();
    Tally tally;
    std::vector<std::size_t> places = {8, 12, 16, 20, 24, 28, 32, 36};
    for (std::size_t i = 0; i < 4; ++i) places.push_back(normal_at + 4 * i);
    for (const std::size_t at : places) {
        for (const std::int64_t bound : {0LL, 1LL << 18, 1LL << 20, 1LL << 21, (1LL << 21) + (1LL << 16), 1LL << 26,
                                         1LL << 28, 1LL << 30, 1LL << 31}) {
            for (const int sign : {-1, 1}) {
                for (int beside = -2; beside <= 2; ++beside) {
                    SCOPED_TRACE(std::to_string(at) + ": " + std::to_string(sign * bound + beside));
                    Payload other = payload;
                    put_number(other, at, static_cast<std::uint64_t>(sign * bound + beside), 4);
                    judge(other, ring, tally);
                }
            }
        }
    }
    const auto scale = static_cast<std::int64_t>(u32_at(payload, 12));
    for (int beside = -4; beside <= 4; ++beside) {
        Payload other = payload;
        put_number(other, 12, static_cast<std::uint64_t>(scale + beside), 4);
        judge(other, ring, tally);
    }
    EXPECT_GT(tally.accepted, 100);
    EXPECT_GT(tally.refused, 300);
}

// Any bytes decode to some cells; here the stated number of surfaces is corrected.
TEST(ReferenceShape, CellsOfAnyBytesAreReadTheSame) {
    const Ring ring = small_shaped().rings[0];
    std::mt19937_64 random(6);
    Tally tally;
    for (int i = 0; i < 400 && !testing::Test::HasFatalFailure(); ++i) {
        SCOPED_TRACE(i);
        Payload payload = object_chunks::shape_payload(ring);
        payload.resize(payload.size() - u32_at(payload, kCellBytesAt));
        std::vector<std::byte> bytes(random() % 80);
        for (std::byte& byte : bytes) byte = static_cast<std::byte>(i % 2 == 0 ? random() : random() & random());
        ShapeMap shape = ring.shape;
        shape_coding::decode_cells(bytes, shape);
        const auto surfaces = std::ranges::count_if(shape.cells, &ShapeCell::has_surface);
        put_number(payload, kSurfacesAt, static_cast<std::uint64_t>(surfaces), 4);
        put_number(payload, kCellBytesAt, bytes.size(), 4);
        payload.insert(payload.end(), bytes.begin(), bytes.end());
        judge(payload, ring, tally);
    }
    EXPECT_EQ(tally.accepted, 400);
}

// Ring 1 of raw-shape.rso, which has 3 views and 3 planes, and the files derived from it.
TEST(ReferenceShape, GoldenFilesAreJudgedTheSame) {
    const fs::path folder = fs::path(RAYSPACE_SOURCE_DIR) / "tests" / "reference" / "golden";
    const Ring ring = small_shaped().rings[0];
    Tally tally;
    const auto judge_file = [&](const fs::path& path) {
        SCOPED_TRACE(path.string());
        const auto file = ContainerReader::open(path);
        ASSERT_TRUE(file.ok()) << file.error().message;
        const ChunkEntry* const entry = file->find(object_chunks::kShape, 1);
        ASSERT_NE(entry, nullptr);
        const auto payload = file->read(*entry);
        ASSERT_TRUE(payload.ok()) << payload.error().message;
        judge(*payload, ring, tally);
    };
    judge_file(folder / "valid" / "raw-shape.rso");
    EXPECT_EQ(tally.accepted, 1);
    for (const auto& entry : fs::directory_iterator(folder / "invalid")) {
        if (entry.path().filename().string().rfind("shape-", 0) == 0) judge_file(entry.path());
    }
    EXPECT_EQ(tally.accepted, 1);
    EXPECT_GE(tally.refused, 27);
}

}  // namespace
}  // namespace rs::reference
