#include "rayspace/format/chunks/shape_chunk.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/chunks/chunk_kind.hpp"
#include "rayspace/format/content_coding.hpp"
#include "rayspace/format/object_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace rs::object_chunks {

using namespace object_ranges;

namespace {

constexpr std::uint8_t kCoding = 2;  // format 2.3; lower codings are of files up to 2.2
constexpr std::size_t kReserved_bytes = 1;
constexpr std::size_t kFixed_bytes = 48;
constexpr std::size_t kNormalLine_bytes = 16;

std::uint64_t surfaces_of(const ShapeMap& shape) {
    return static_cast<std::uint64_t>(std::count_if(shape.cells.begin(), shape.cells.end(),
                                                    [](const ShapeCell& cell) { return cell.has_surface(); }));
}

void put_numbers(const ShapeMap& shape, ByteWriter& out) {
    out.put(static_cast<std::uint16_t>(shape.p_cells));
    out.put(static_cast<std::uint16_t>(shape.bands));
    out.put(shape.p_half_q20);
    out.put(shape.p_cells_per_unit_q12);
    out.put(shape.h_low_q20);
    out.put(shape.bands_per_unit_q12);
    out.put(shape.reference_distance_q20);
    out.put(shape.reference_height_q20);
    out.put(shape.depth_low_q20);
    out.put(shape.depth_step_q24);
}

void get_numbers(ByteReader& in, ShapeMap& shape) {
    shape.p_cells = in.get<std::uint16_t>();
    shape.bands = in.get<std::uint16_t>();
    shape.p_half_q20 = in.get<std::int32_t>();
    shape.p_cells_per_unit_q12 = in.get<std::int32_t>();
    shape.h_low_q20 = in.get<std::int32_t>();
    shape.bands_per_unit_q12 = in.get<std::int32_t>();
    shape.reference_distance_q20 = in.get<std::int32_t>();
    shape.reference_height_q20 = in.get<std::int32_t>();
    shape.depth_low_q20 = in.get<std::int32_t>();
    shape.depth_step_q24 = in.get<std::int32_t>();
}

// Reads the gaps; returns their total number of lines.
Result<std::uint64_t> get_gaps(ByteReader& in, ShapeMap& shape) {
    std::uint32_t lines = 0;  // at most kMaxViews * kMaxGapLines
    for (ShapeGap& gap : shape.gaps) {
        gap.lines = in.get<std::uint16_t>();
        gap.first_line = lines;
        if (gap.lines > kMaxGapLines) {
            return Error{"a gap has " + std::to_string(gap.lines) + " lines; 0.." + std::to_string(kMaxGapLines) +
                         " are possible"};
        }
        lines += gap.lines;
    }
    return std::uint64_t{lines};
}

Status check_counts(const CodedShapeCells& coded) {
    if (coded.cells > kMaxShapeCells) {
        return Error{"has " + std::to_string(coded.cells) + " cells; at most " + std::to_string(kMaxShapeCells) +
                     " are possible"};
    }
    if (coded.surfaces > coded.cells) {
        return Error{"claims " + std::to_string(coded.surfaces) + " cells with a surface among " +
                     std::to_string(coded.cells)};
    }
    return {};
}

constexpr std::int32_t kMaxBandsPerUnit_q12 = 1 << 26;
constexpr std::int32_t kMaxDepthStep_q24 = 1 << 18;

bool is_within(std::int32_t number, std::int64_t lowest, std::int64_t highest) {
    return number >= lowest && number <= highest;
}

Status check_numbers(const ShapeMap& shape) {
    if (!is_map_side(shape.p_cells) || !is_map_side(shape.bands)) {
        return Error{"lines of " + std::to_string(shape.p_cells) + "x" + std::to_string(shape.bands) +
                     " cells; each side must be 1.." + std::to_string(kMaxMapSide)};
    }
    if (!is_within(shape.p_half_q20, kOne_q20, kMaxHalf_q20 - 1)) {
        return Error{"its half width along p is not within 1 and 2 + 1/16"};
    }
    if (!is_consistent(shape.p_cells_per_unit_q12, shape.p_cells, std::ldexp(shape.p_half_q20, -20))) {
        return Error{"its cells per unit contradict its size"};
    }
    if (!is_within(shape.bands_per_unit_q12, 1, kMaxBandsPerUnit_q12)) {
        return Error{"its bands per unit are not between 0 and 16384"};
    }
    if (!below(shape.h_low_q20, kMaxDistance_q20)) return Error{"its lowest height is 256 object radii or more"};
    if (!is_within(shape.reference_distance_q20, kOne_q20 + 1, kMaxDistance_q20 - 1)) {
        return Error{"its reference distance is not between 1 and 256 object radii"};
    }
    if (!below(shape.reference_height_q20, kMaxDistance_q20)) {
        return Error{"its reference height is 256 object radii or more"};
    }
    if (!below(shape.depth_low_q20, kMaxHalf_q20 + 1)) return Error{"its lowest depth is beyond 2 + 1/16"};
    if (!is_within(shape.depth_step_q24, 1, kMaxDepthStep_q24)) {
        return Error{"its depth step is not between 0 and 1/64"};
    }
    if (!is_within(shape.jump, 1, 255)) return Error{"its jump is not between 1 and 255 depth steps"};
    if (!is_within(shape.thickness, 0, 255)) return Error{"its thickness is not between 0 and 255 depth steps"};
    return {};
}

Status check_normal_line(const NormalLine& line) {
    // |l2| <= 1, since it is the cosine of an angle.
    if (!below(line.l2_q30, kOne_q30 + 1)) return Error{"the depth of one of its normal lines is out of range"};
    if (!below(line.q2_q16, kMaxPixels_q16)) return Error{"the columns of one of its normal lines are out of range"};
    if (!below(line.a_q20, kMaxDistance_q20) || !below(line.c_q20, kMaxDistance_q20)) {
        return Error{"the camera of one of its normal lines is 256 object radii away or more"};
    }
    return {};
}

Status check_gaps(const Ring& ring) {
    const ShapeMap& shape = ring.shape;
    if (shape.gaps.size() != ring.views.size()) return Error{"it does not have one gap per view"};
    std::uint64_t lines = 0;
    for (std::size_t n = 0; n < shape.gaps.size(); ++n) {
        const ShapeGap& gap = shape.gaps[n];
        if (gap.lines > kMaxGapLines) {
            return Error{"gap " + std::to_string(n) + " has " + std::to_string(gap.lines) + " lines; 0.." +
                         std::to_string(kMaxGapLines) + " are possible"};
        }
        if (gap.first_line != lines) return Error{"gap " + std::to_string(n) + " does not begin behind its forerunner"};
        lines += gap.lines;
    }
    const std::uint64_t cells =
        lines * static_cast<std::uint64_t>(shape.p_cells) * static_cast<std::uint64_t>(shape.bands);
    if (cells > kMaxShapeCells) {
        return Error{"it has " + std::to_string(cells) + " cells; at most " + std::to_string(kMaxShapeCells) +
                     " are possible"};
    }
    if (shape.cells.size() != cells) return Error{"it does not have as many cells as its sizes say"};
    return {};
}

// Unused values are 0, so that equal maps are equal in memory and the file need not store them.
Status check_cell(const ShapeCell& cell) {
    if (!cell.has_surface() && cell.depth != 0) return Error{"has a depth and no surface"};
    if (cell.shown > ShapeCell::kByBoth) return Error{"is shown by images that its gap does not have"};
    return {};
}

Result<ChunkMemory> shape_memory(Bytes payload, PartialObject& partial, std::uint32_t index) {
    RS_ASSIGN_OR_RETURN(const auto coded, parse_shape_head(payload, partial.object.rings[index]));
    return ChunkMemory{.kept_bytes = coded.cells * sizeof(ShapeCell)};
}

Status parse_shape(Bytes payload, PartialObject& partial, std::uint32_t index) {
    const auto coded = parse_shape_head(payload, partial.object.rings[index]);
    return coded ? parse_shape_cells(*coded, partial.object.rings[index].shape) : coded.error();
}

Status check_shape_of_ring(const RaySpaceObject& object, std::uint32_t index) {
    const Status status = check_shape(object.rings[index]);
    return status ? Status{} : Status{Error{"its shape map: " + status.error().message}};
}

std::int64_t held_by_shape(const RaySpaceObject& object, std::uint32_t index) {
    const ShapeMap& shape = object.rings[index].shape;
    return heap_bytes_of(shape.gaps) + heap_bytes_of(shape.normal_lines) + heap_bytes_of(shape.cells);
}

}  // namespace

Payload shape_payload(const Ring& ring) {
    const ShapeMap& shape = ring.shape;
    RS_CHECK(!shape.empty());
    const Payload cells = shape_coding::encode_cells(shape);
    ByteWriter out;
    out.put(kCoding);
    out.put(static_cast<std::uint8_t>(shape.jump));
    out.put(static_cast<std::uint8_t>(shape.thickness));
    out.put_zeros(kReserved_bytes);
    put_numbers(shape, out);
    out.put(static_cast<std::uint32_t>(surfaces_of(shape)));
    out.put(static_cast<std::uint32_t>(cells.size()));
    for (const ShapeGap& gap : shape.gaps) out.put(gap.lines);
    for (const NormalLine& line : shape.normal_lines) {
        out.put(line.l2_q30);
        out.put(line.q2_q16);
        out.put(line.a_q20);
        out.put(line.c_q20);
    }
    out.put(std::span<const std::byte>(cells));
    return out.bytes();
}

Result<CodedShapeCells> parse_shape_head(std::span<const std::byte> payload, Ring& ring) {
    ShapeMap& shape = ring.shape;
    ByteReader in(payload);
    const auto coding = in.get<std::uint8_t>();
    if (!in.ok()) return Error{"is empty"};
    if (coding < kCoding) {
        return Error{"has shape coding " + std::to_string(coding) +
                     ", of a file older than format 2.3; encode the capture set anew"};
    }
    if (coding > kCoding) {
        return Error{"has shape coding " + std::to_string(coding) + ", which is not known here; update these tools"};
    }
    shape.jump = in.get<std::uint8_t>();
    shape.thickness = in.get<std::uint8_t>();
    const bool is_reserved_zero = in.take_zeros(kReserved_bytes);
    get_numbers(in, shape);
    CodedShapeCells coded;
    coded.surfaces = in.get<std::uint32_t>();
    const auto cell_bytes = in.get<std::uint32_t>();
    if (!in.ok()) return Error{"is too short"};
    if (!is_reserved_zero) return Error{"has reserved bytes that are not zero"};
    if (!is_map_side(shape.p_cells) || !is_map_side(shape.bands)) {
        return Error{"has lines of " + std::to_string(shape.p_cells) + "x" + std::to_string(shape.bands) +
                     " cells; each side must be 1.." + std::to_string(kMaxMapSide)};
    }

    const std::size_t normal_lines = ring.views.size() * static_cast<std::size_t>(ring.planes);
    const std::uint64_t expected_bytes =
        kFixed_bytes + ring.views.size() * sizeof(std::uint16_t) + normal_lines * kNormalLine_bytes + cell_bytes;
    if (payload.size() != expected_bytes) {
        return wrong_size(payload.size(), expected_bytes);
    }
    shape.gaps.resize(ring.views.size());
    RS_ASSIGN_OR_RETURN(const auto lines, get_gaps(in, shape));
    shape.normal_lines.resize(normal_lines);
    for (NormalLine& line : shape.normal_lines) {
        line.l2_q30 = in.get<std::int32_t>();
        line.q2_q16 = in.get<std::int32_t>();
        line.a_q20 = in.get<std::int32_t>();
        line.c_q20 = in.get<std::int32_t>();
    }
    coded.cells = lines * static_cast<std::uint64_t>(shape.p_cells) * static_cast<std::uint64_t>(shape.bands);
    RS_TRY(check_counts(coded));
    coded.bytes = in.take(cell_bytes);
    return coded;
}

Status parse_shape_cells(const CodedShapeCells& coded, ShapeMap& shape) {
    shape.cells.assign(static_cast<std::size_t>(coded.cells), ShapeCell{});
    shape_coding::decode_cells(coded.bytes, shape);
    const std::uint64_t found = surfaces_of(shape);
    if (found != coded.surfaces) {
        return Error{"claims " + std::to_string(coded.surfaces) + " cells with a surface, but has " +
                     std::to_string(found)};
    }
    return {};
}

Status check_shape(const Ring& ring) {
    const ShapeMap& shape = ring.shape;
    if (shape.empty()) return shape == ShapeMap{} ? Status{} : Status{Error{"it has no gaps and yet numbers or cells"}};
    RS_TRY(check_numbers(shape));
    RS_TRY(check_gaps(ring));
    if (shape.normal_lines.size() != ring.views.size() * static_cast<std::size_t>(ring.planes)) {
        return Error{"it does not have one normal line per view and plane"};
    }
    for (const NormalLine& line : shape.normal_lines) {
        RS_TRY(check_normal_line(line));
    }
    for (std::size_t i = 0; i < shape.cells.size(); ++i) {
        if (const Status status = check_cell(shape.cells[i]); !status) {
            return Error{"cell " + std::to_string(i) + " " + status.error().message};
        }
    }
    return {};
}

ChunkKind shape_chunk() {
    return {.name = kShape,
            .each = ChunkScope::ring,
            .stage = ReadStage::shapes,
            .is_present = [](const RaySpaceObject& object, std::uint32_t r) { return !object.rings[r].shape.empty(); },
            .payload = [](const RaySpaceObject& object, std::uint32_t r) { return shape_payload(object.rings[r]); },
            .memory = shape_memory,
            .parse = parse_shape,
            .validate = check_shape_of_ring,
            .heap_bytes = held_by_shape};
}

}  // namespace rs::object_chunks
