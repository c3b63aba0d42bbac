// Chunk RMAP r: the cells of object.rings[r] as runs along u; the ring has its sizes from RING.
#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/zstd_frame.hpp"
#include "rayspace/format/chunks/chunk_kind.hpp"
#include "rayspace/format/content_coding.hpp"
#include "rayspace/format/object_ranges.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace rs::object_chunks {

using namespace object_ranges;

namespace {

// Content of a map's frame and its runs are in memory at the same time.
constexpr std::uint64_t kRunsOverContent = 2;

// Head of a coded map. A few bytes may contain many runs, so that content_bytes is checked against the memory limit
// before decompression.
struct CodedMap {
    std::size_t rows = 0;
    std::size_t runs = 0;
    std::uint64_t content_bytes = 0;  // decompressed size of the frame
    Bytes frame;                      // part of the payload
};

Result<CodedMap> parse_map_head(Bytes payload, const Ring& ring) {
    ByteReader in(payload);
    CodedMap coded;
    coded.runs = in.get<std::uint32_t>();
    if (!in.ok()) return Error{"ends inside its number of runs"};
    coded.rows = static_cast<std::size_t>(ring.planes) * static_cast<std::size_t>(ring.x_cells);
    const std::uint64_t cells = coded.rows * static_cast<std::uint64_t>(ring.u_cells);
    if (coded.runs < coded.rows || coded.runs > cells) {
        return out_of_range("the number of runs", coded.runs, coded.rows, cells);
    }
    coded.content_bytes = map_coding::residual_bytes(coded.rows, coded.runs);
    coded.frame = in.take(in.left());
    RS_TRY(check_zstd_frame(coded.frame, coded.content_bytes, "its runs"));
    return coded;
}

Result<ChunkMemory> map_memory(Bytes payload, PartialObject& partial, std::uint32_t index) {
    RS_ASSIGN_OR_RETURN(const auto coded, parse_map_head(payload, partial.object.rings[index]));
    return ChunkMemory{.temporary_bytes = kRunsOverContent * coded.content_bytes};
}

Status parse_map(Bytes payload, PartialObject& partial, std::uint32_t index) {
    Ring& ring = partial.object.rings[index];
    RS_ASSIGN_OR_RETURN(const auto coded, parse_map_head(payload, ring));
    std::vector<std::uint8_t> plane;
    RS_TRY(decompress_zstd_frame(coded.frame, coded.content_bytes, "its runs", plane));
    ring.cells.resize(coded.rows * static_cast<std::size_t>(ring.u_cells));
    return map_coding::decode_runs(map_coding::decode_run_residuals(plane, coded.rows, coded.runs), ring.u_cells,
                                   ring.cells);
}

// The larger depth of `line` at both ends of column xi of the map, q50.
std::int64_t larger_depth_q50(const CapturedLine& line, const Ring& ring, int xi) {
    const auto depth_at = [&](int column) {
        const std::int64_t x_q20 = 2 * std::int64_t{ring.x_half_q20} * column / ring.x_cells - ring.x_half_q20;
        return std::int64_t{line.l0_q20} * kOne_q30 + x_q20 * line.l1_q30;
    };
    return std::max(depth_at(xi), depth_at(xi + 1));
}

// Checks that every cell is empty or names a view of the ring with a part of the cell in front of it. (The renderer
// treats rays as empty if the point is closer to the camera than its arithmetic can express.)
Status check_cells(const RaySpaceObject& object, std::uint32_t index) {
    const Ring& ring = object.rings[index];
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    const auto x_cells = static_cast<std::size_t>(ring.x_cells);
    const auto u_cells = static_cast<std::size_t>(ring.u_cells);
    const std::size_t rows = static_cast<std::size_t>(ring.planes) * x_cells;
    if (ring.cells.size() != rows * u_cells) return Error{"its map does not have as many cells as its sizes say"};
    std::vector<bool> is_of_ring(object.views.size());
    for (const std::uint16_t view : ring.views) is_of_ring[view] = true;
    std::vector<std::size_t> checked_in_row(object.views.size(), kNone);
    for (std::size_t row = 0; row < rows; ++row) {
        for (const std::uint16_t view : std::span(ring.cells).subspan(row * u_cells, u_cells)) {
            if (view == kNoImage) continue;
            const auto place = [&] {
                return "plane " + std::to_string(row / x_cells) + ", row " + std::to_string(row % x_cells) +
                       " of its map names view " + std::to_string(view) + ", which ";
            };
            if (view >= object.views.size() || !is_of_ring[view]) return Error{place() + "is not one of the ring's"};
            if (std::exchange(checked_in_row[view], row) == row) continue;
            const CapturedLine& line = object.views[view].lines[row / x_cells];
            if (larger_depth_q50(line, ring, static_cast<int>(row % x_cells)) < 0) {
                return Error{place() + "looks away from it"};
            }
        }
    }
    return {};
}

std::int64_t held_by_map(const RaySpaceObject& object, std::uint32_t index) {
    return heap_bytes_of(object.rings[index].cells);
}

}  // namespace

Payload map_payload(const map_coding::Runs& runs) {
    const std::vector<std::byte> frame = compress_zstd(map_coding::encode_residuals(runs));
    ByteWriter out;
    out.reserve(sizeof(std::uint32_t) + frame.size());
    out.put(static_cast<std::uint32_t>(runs.views.size()));
    out.put(std::span<const std::byte>(frame));
    return out.bytes();
}

Payload map_payload(const Ring& ring) {
    return map_payload(map_coding::encode_runs(ring.cells, ring.u_cells));
}

ChunkKind map_chunk() {
    return {.name = kMap,
            .each = ChunkScope::ring,
            .stage = ReadStage::maps,
            .payload = [](const RaySpaceObject& object, std::uint32_t r) { return map_payload(object.rings[r]); },
            .memory = map_memory,
            .parse = parse_map,
            .validate = check_cells,
            .heap_bytes = held_by_map};
}

}  // namespace rs::object_chunks
