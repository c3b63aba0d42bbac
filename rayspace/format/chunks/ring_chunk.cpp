// Chunk RING r: all of object.rings[r] except its cells and its shape map, and the lines of the ring's views. Views of
// other rings are rejected.
#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/zstd_frame.hpp"
#include "rayspace/format/chunks/chunk_kind.hpp"
#include "rayspace/format/content_coding.hpp"
#include "rayspace/format/object_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace rs::object_chunks {

using namespace object_ranges;

namespace {

constexpr std::int32_t kMaxElevation_udeg = 90'000'000;

void put_line(const CapturedLine& line, ByteWriter& out) {
    out.put(line.l0_q20);
    out.put(line.l1_q30);
    out.put(line.q0_q16);
    out.put(line.q1_q16);
}

CapturedLine get_line(ByteReader& in) {
    CapturedLine line;
    line.l0_q20 = in.get<std::int32_t>();
    line.l1_q30 = in.get<std::int32_t>();
    line.q0_q16 = in.get<std::int32_t>();
    line.q1_q16 = in.get<std::int32_t>();
    return line;
}

// Parses the lines from the rest of a RING payload.
Result<std::vector<CapturedLine>> parse_lines(ByteReader& in, std::size_t views, int planes, std::uint8_t coding) {
    std::vector<CapturedLine> lines(views * static_cast<std::size_t>(planes));
    const std::size_t plain_bytes = lines.size() * line_coding::kBytesPerLine;
    if (coding == static_cast<std::uint8_t>(LineCoding::kPlain)) {
        if (in.left() != plain_bytes) {
            return Error{"holds " + std::to_string(in.left()) + " bytes of lines instead of " +
                         std::to_string(plain_bytes)};
        }
        for (CapturedLine& line : lines) line = get_line(in);
        return lines;
    }
    if (coding != static_cast<std::uint8_t>(LineCoding::kResiduals)) {
        return Error{"has line coding " + std::to_string(coding) + ", which is not known here; update these tools"};
    }
    RS_ASSIGN_OR_RETURN(const std::vector<std::uint8_t> plane,
                        decompress_zstd(in.take(in.left()), plain_bytes, "its lines"));
    line_coding::decode_residuals(plane, planes, lines);
    return lines;
}

Status check_ring_geometry(const Ring& ring) {
    if (std::abs(std::int64_t{ring.elevation_udeg}) > kMaxElevation_udeg)
        return Error{"its elevation is beyond 90 degrees"};
    if (ring.planes < kMinPlanes || ring.planes > kMaxPlanes) {
        return Error{"it has " + std::to_string(ring.planes) + " planes; " + std::to_string(kMinPlanes) + ".." +
                     std::to_string(kMaxPlanes) + " are possible"};
    }
    if (!is_map_side(ring.x_cells) || !is_map_side(ring.u_cells)) {
        return Error{"its map is " + std::to_string(ring.x_cells) + "x" + std::to_string(ring.u_cells) +
                     " cells; each side must be 1.." + std::to_string(kMaxMapSide)};
    }
    if (ring.x_half_q20 < kOne_q20 || ring.x_half_q20 >= kMaxHalf_q20) {
        return Error{"its map's half width along x is not within 1 and 2 + 1/16"};
    }
    const std::int64_t squarest_q28 = std::llround(std::ldexp(std::tan(kPi / ring.planes), 28));
    if (ring.u_half_q28 <= squarest_q28 || ring.u_half_q28 > 2 * squarest_q28) {
        return Error{"its map's half width along u is not between tan(pi / planes) and twice that"};
    }
    if (!is_consistent(ring.x_cells_per_unit_q12, ring.x_cells, std::ldexp(ring.x_half_q20, -20)) ||
        !is_consistent(ring.u_cells_per_unit_q12, ring.u_cells, std::ldexp(ring.u_half_q28, -28))) {
        return Error{"its map's cells per unit contradict its size"};
    }
    return {};
}

Status check_ring(const RaySpaceObject& object, std::uint32_t index) {
    const Ring& ring = object.rings[index];
    RS_TRY(check_ring_geometry(ring));
    if (ring.views.empty()) return Error{"it has no views"};
    std::vector<bool> is_taken = ring_membership(object, index);
    for (const std::uint16_t view : ring.views) {
        if (view >= object.views.size()) return Error{"view " + std::to_string(view) + " does not exist"};
        if (is_taken[view]) return Error{"view " + std::to_string(view) + " is in a ring already"};
        is_taken[view] = true;
        if (object.views[view].lines.size() != static_cast<std::size_t>(ring.planes)) {
            return Error{"view " + std::to_string(view) + " does not have one line per plane"};
        }
    }
    return {};
}

std::int64_t held_by_ring(const RaySpaceObject& object, std::uint32_t index) {
    return heap_bytes_of(object.rings[index].views);
}

}  // namespace

Payload ring_payload(const RaySpaceObject& object, std::size_t index, LineCoding coding) {
    const Ring& ring = object.rings[index];
    ByteWriter out;
    out.put(ring.elevation_udeg);
    out.put(static_cast<std::uint8_t>(ring.planes));
    out.put(static_cast<std::uint8_t>(coding));
    out.put(static_cast<std::uint16_t>(ring.views.size()));
    out.put(static_cast<std::uint16_t>(ring.x_cells));
    out.put(static_cast<std::uint16_t>(ring.u_cells));
    out.put(ring.x_half_q20);
    out.put(ring.x_cells_per_unit_q12);
    out.put(ring.u_half_q28);
    out.put(ring.u_cells_per_unit_q12);
    for (const std::uint16_t view : ring.views) out.put(view);
    std::vector<CapturedLine> lines;
    for (const std::uint16_t view : ring.views) {
        const std::vector<CapturedLine>& of_view = object.views[view].lines;
        lines.insert(lines.end(), of_view.begin(), of_view.end());
    }
    if (coding == LineCoding::kPlain) {
        for (const CapturedLine& line : lines) put_line(line, out);
    } else {
        out.put(std::span<const std::byte>(compress_zstd(line_coding::encode_residuals(lines, ring.planes))));
    }
    return out.bytes();
}

Status parse_ring(std::span<const std::byte> payload, RaySpaceObject& object, std::size_t index) {
    Ring& ring = object.rings[index];
    ByteReader in(payload);
    ring.elevation_udeg = in.get<std::int32_t>();
    const auto planes = in.get<std::uint8_t>();
    const auto coding = in.get<std::uint8_t>();
    const auto view_count = in.get<std::uint16_t>();
    const auto x_cells = in.get<std::uint16_t>();
    const auto u_cells = in.get<std::uint16_t>();
    ring.x_half_q20 = in.get<std::int32_t>();
    ring.x_cells_per_unit_q12 = in.get<std::int32_t>();
    ring.u_half_q28 = in.get<std::int32_t>();
    ring.u_cells_per_unit_q12 = in.get<std::int32_t>();
    if (!in.ok()) return Error{"is too short"};
    if (planes < kMinPlanes || planes > kMaxPlanes) {
        return out_of_range("the number of planes", planes, kMinPlanes, kMaxPlanes);
    }
    if (view_count < 1 || view_count > object.views.size()) {
        return out_of_range("the number of views", view_count, 1, object.views.size());
    }
    if (x_cells < 1 || x_cells > kMaxMapSide) return out_of_range("the map's size along x", x_cells, 1, kMaxMapSide);
    if (u_cells < 1 || u_cells > kMaxMapSide) return out_of_range("the map's size along u", u_cells, 1, kMaxMapSide);
    if (in.left() < view_count * sizeof(std::uint16_t)) return Error{"ends inside of its list of views"};
    ring.planes = planes;
    ring.x_cells = x_cells;
    ring.u_cells = u_cells;
    ring.views.resize(view_count);
    for (std::uint16_t& view : ring.views) {
        view = in.get<std::uint16_t>();
        if (view >= object.views.size()) return out_of_range("a view's number", view, 0, object.views.size() - 1);
        if (!object.views[view].lines.empty()) {
            return Error{"names view " + std::to_string(view) + " a second time; a view belongs to one ring, once"};
        }
        object.views[view].lines.resize(planes);
    }
    RS_ASSIGN_OR_RETURN(const std::vector<CapturedLine> lines, parse_lines(in, view_count, planes, coding));
    auto next = lines.begin();
    for (const std::uint16_t view : ring.views) {
        std::copy_n(next, planes, object.views[view].lines.begin());
        next += planes;
    }
    return {};
}

ChunkKind ring_chunk() {
    return {.name = kRing,
            .each = ChunkScope::ring,
            .payload = [](const RaySpaceObject& object, std::uint32_t index) { return ring_payload(object, index); },
            .parse = [](Bytes payload, PartialObject& partial,
                        std::uint32_t index) { return parse_ring(payload, partial.object, index); },
            .validate = check_ring,
            .heap_bytes = held_by_ring};
}

}  // namespace rs::object_chunks
