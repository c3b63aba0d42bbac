#include "rayspace/format/shape_chunk.hpp"

#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/format/shape_coding.hpp"

#include <algorithm>
#include <string>

namespace rs::object_chunks {
namespace {

constexpr std::uint8_t kCoding = 2;  // those before were of files up to 2.2
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

// Gaps and how many lines they have together.
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

}  // namespace

Payload shape_payload(const Ring& ring) {
    const ShapeMap& shape = ring.shape;
    RS_CHECK(!shape.empty());
    const Payload cells = shape_coding::coded_cells(shape);
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
    const auto is_side = [](int side) { return side >= 1 && side <= kMaxMapSide; };
    if (!is_side(shape.p_cells) || !is_side(shape.bands)) {
        return Error{"has lines of " + std::to_string(shape.p_cells) + "x" + std::to_string(shape.bands) +
                     " cells; each side must be 1.." + std::to_string(kMaxMapSide)};
    }

    const std::size_t normal_lines = ring.views.size() * static_cast<std::size_t>(ring.planes);
    const std::uint64_t expected_bytes =
        kFixed_bytes + ring.views.size() * sizeof(std::uint16_t) + normal_lines * kNormalLine_bytes + cell_bytes;
    if (payload.size() != expected_bytes) {
        return Error{"is " + std::to_string(payload.size()) + " bytes long instead of " +
                     std::to_string(expected_bytes)};
    }
    shape.gaps.resize(ring.views.size());
    const auto lines = get_gaps(in, shape);
    if (!lines) return lines.error();
    shape.normal_lines.resize(normal_lines);
    for (NormalLine& line : shape.normal_lines) {
        line.l2_q30 = in.get<std::int32_t>();
        line.q2_q16 = in.get<std::int32_t>();
        line.a_q20 = in.get<std::int32_t>();
        line.c_q20 = in.get<std::int32_t>();
    }
    coded.cells = *lines * static_cast<std::uint64_t>(shape.p_cells) * static_cast<std::uint64_t>(shape.bands);
    if (Status status = check_counts(coded); !status) return status.error();
    coded.bytes = in.take(cell_bytes);
    return coded;
}

Status parse_shape_cells(const CodedShapeCells& coded, ShapeMap& shape) {
    shape.cells.assign(static_cast<std::size_t>(coded.cells), ShapeCell{});
    shape_coding::put_cells(coded.bytes, shape);
    const std::uint64_t found = surfaces_of(shape);
    if (found != coded.surfaces) {
        return Error{"claims " + std::to_string(coded.surfaces) + " cells with a surface, but has " +
                     std::to_string(found)};
    }
    return {};
}

}  // namespace rs::object_chunks
