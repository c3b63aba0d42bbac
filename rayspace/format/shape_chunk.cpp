#include "rayspace/format/shape_chunk.hpp"

#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/zstd_frame.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <vector>

namespace rs::object_chunks {
namespace {

constexpr int kNone = -1;

// The depths around one cell of the map, by their distance from it in lines, in p and in bands; kNone: no such cell, or
// it is empty.
class Neighbourhood {
public:
    explicit Neighbourhood(const ShapeMap& shape)
        : shape_(shape),
          p_cells_(shape.p_cells),
          bands_(shape.bands),
          line_stride_(std::ptrdiff_t{shape.p_cells} * shape.bands) {}

    // Call for every cell of the map in its order.
    void go_to_next() {
        ++index_;
        if (++band_ < bands_) return;
        band_ = 0;
        if (++p_ < p_cells_) return;
        p_ = 0;
        ++line_;
    }
    [[nodiscard]] std::size_t index() const { return static_cast<std::size_t>(index_); }

    [[nodiscard]] int at(int line_step, int p_step, int band_step) const {
        const int p = p_ + p_step;
        const int band = band_ + band_step;
        if (line_ + line_step < 0 || p < 0 || p >= p_cells_ || band < 0 || band >= bands_) return kNone;
        const std::ptrdiff_t index = index_ + line_step * line_stride_ + std::ptrdiff_t{p_step} * bands_ + band_step;
        const ShapeCell& cell = shape_.cells[static_cast<std::size_t>(index)];
        return cell.has_surface() ? cell.depth : kNone;
    }

private:
    const ShapeMap& shape_;
    int p_cells_;
    int bands_;
    std::ptrdiff_t line_stride_;
    std::ptrdiff_t index_ = 0;
    int line_ = 0;
    int p_ = 0;
    int band_ = 0;
};

// The median of what the neighbours suggest, each by itself or by the slope of a surface through three of them. Looks
// only at cells that stand before this one.
std::uint8_t predict(const Neighbourhood& around) {
    constexpr int kWithoutNeighbours = 128;
    std::array<int, 9> candidates{};
    std::size_t count = 0;
    const auto suggest = [&](int value) {
        if (value != kNone) candidates[count++] = value;
    };
    // From `a`, as much as `to` differs from `from`.
    const auto suggest_slope = [&](int a, int to, int from) {
        if (a != kNone && to != kNone && from != kNone) candidates[count++] = std::clamp(a + to - from, 0, 255);
    };
    const int below = around.at(0, 0, -1);
    const int beside = around.at(0, -1, 0);
    const int beside_below = around.at(0, -1, -1);
    const int beside_above = around.at(0, -1, 1);
    const int before = around.at(-1, 0, 0);
    const int before_below = around.at(-1, 0, -1);
    const int before_beside = around.at(-1, -1, 0);
    const int before_beside_above = around.at(-1, -1, 1);
    const int before_far = around.at(-1, 1, 0);
    const int before_far_below = around.at(-1, 1, -1);
    suggest(below);
    suggest(beside);
    suggest(before);
    suggest_slope(below, beside, beside_below);
    suggest_slope(below, beside_above, beside);
    suggest_slope(before, below, before_below);
    suggest_slope(before, beside, before_beside);
    suggest_slope(before, beside_above, before_beside_above);
    suggest_slope(below, before_far, before_far_below);
    if (count == 0) return kWithoutNeighbours;
    std::sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count));
    return static_cast<std::uint8_t>((candidates[(count - 1) / 2] + candidates[count / 2]) / 2);
}

}  // namespace

std::size_t surfaces_of(const ShapeMap& shape) {
    return static_cast<std::size_t>(std::count_if(shape.cells.begin(), shape.cells.end(),
                                                  [](const ShapeCell& cell) { return cell.has_surface(); }));
}

std::vector<std::uint8_t> shown_plane(const ShapeMap& shape) {
    std::vector<std::uint8_t> plane(shown_plane_bytes(shape.cells.size()));
    for (std::size_t i = 0; i < shape.cells.size(); ++i) {
        plane[i / 4] = static_cast<std::uint8_t>(plane[i / 4] | shape.cells[i].shown << 2 * (i % 4));
    }
    return plane;
}

std::vector<std::uint8_t> residual_plane(const ShapeMap& shape) {
    std::vector<std::uint8_t> plane;
    plane.reserve(surfaces_of(shape));
    Neighbourhood around(shape);
    for (; around.index() < shape.cells.size(); around.go_to_next()) {
        const ShapeCell& cell = shape.cells[around.index()];
        if (cell.has_surface()) plane.push_back(static_cast<std::uint8_t>(cell.depth - predict(around)));
    }
    return plane;
}

Status put_shown(std::span<const std::uint8_t> plane, ShapeMap& shape) {
    RS_CHECK(plane.size() == shown_plane_bytes(shape.cells.size()));
    for (std::size_t i = 0; i < shape.cells.size(); ++i) {
        shape.cells[i].shown = static_cast<std::uint8_t>(plane[i / 4] >> 2 * (i % 4) & ShapeCell::kByBoth);
    }
    if (shape.cells.size() % 4 != 0 && plane.back() >> 2 * (shape.cells.size() % 4) != 0) {
        return Error{"has bits behind its last cell"};
    }
    return {};
}

void put_residuals(std::span<const std::uint8_t> plane, ShapeMap& shape) {
    std::size_t taken = 0;
    Neighbourhood around(shape);
    for (; around.index() < shape.cells.size(); around.go_to_next()) {
        ShapeCell& cell = shape.cells[around.index()];
        if (!cell.has_surface()) continue;
        RS_CHECK(taken < plane.size());
        cell.depth = static_cast<std::uint8_t>(predict(around) + plane[taken++]);
    }
    RS_CHECK(taken == plane.size());
}

void settle_depths(ShapeMap& shape, int tolerance) {
    Neighbourhood around(shape);
    for (; around.index() < shape.cells.size(); around.go_to_next()) {
        ShapeCell& cell = shape.cells[around.index()];
        if (!cell.has_surface()) continue;
        const std::uint8_t predicted = predict(around);
        if (std::abs(predicted - cell.depth) <= tolerance) cell.depth = predicted;
    }
}

namespace {

constexpr std::uint8_t kCoding = 2;  // those before were of files up to 2.2
constexpr std::size_t kReserved_bytes = 1;
constexpr std::size_t kFixed_bytes = 52;
constexpr std::size_t kNormalLine_bytes = 16;

constexpr const char* kShownName = "what is shown of its cells";
constexpr const char* kResidualsName = "its depths";

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
    const Payload shown = zstd_frame(shown_plane(shape));
    const Payload residuals = zstd_frame(residual_plane(shape));
    ByteWriter out;
    out.put(kCoding);
    out.put(static_cast<std::uint8_t>(shape.jump));
    out.put(static_cast<std::uint8_t>(shape.thickness));
    out.put_zeros(kReserved_bytes);
    put_numbers(shape, out);
    out.put(static_cast<std::uint32_t>(surfaces_of(shape)));
    out.put(static_cast<std::uint32_t>(shown.size()));
    out.put(static_cast<std::uint32_t>(residuals.size()));
    for (const ShapeGap& gap : shape.gaps) out.put(gap.lines);
    for (const NormalLine& line : shape.normal_lines) {
        out.put(line.l2_q30);
        out.put(line.q2_q16);
        out.put(line.a_q20);
        out.put(line.c_q20);
    }
    out.put(std::span<const std::byte>(shown));
    out.put(std::span<const std::byte>(residuals));
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
    const auto shown_bytes = in.get<std::uint32_t>();
    const auto residual_bytes = in.get<std::uint32_t>();
    if (!in.ok()) return Error{"is too short"};
    if (!is_reserved_zero) return Error{"has reserved bytes that are not zero"};
    const auto is_side = [](int side) { return side >= 1 && side <= kMaxMapSide; };
    if (!is_side(shape.p_cells) || !is_side(shape.bands)) {
        return Error{"has lines of " + std::to_string(shape.p_cells) + "x" + std::to_string(shape.bands) +
                     " cells; each side must be 1.." + std::to_string(kMaxMapSide)};
    }

    const std::size_t normal_lines = ring.views.size() * static_cast<std::size_t>(ring.planes);
    const std::uint64_t expected_bytes = kFixed_bytes + ring.views.size() * sizeof(std::uint16_t) +
                                         normal_lines * kNormalLine_bytes + shown_bytes + residual_bytes;
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
    coded.shown = in.take(shown_bytes);
    if (Status status = check_zstd_frame(coded.shown, shown_plane_bytes(coded.cells), kShownName); !status) {
        return status.error();
    }
    coded.residuals = in.take(residual_bytes);
    if (Status status = check_zstd_frame(coded.residuals, coded.surfaces, kResidualsName); !status) {
        return status.error();
    }
    return coded;
}

Status parse_shape_cells(const CodedShapeCells& coded, ShapeMap& shape) {
    shape.cells.assign(static_cast<std::size_t>(coded.cells), ShapeCell{});
    std::vector<std::uint8_t> plane;  // one at a time
    const std::uint64_t plane_bytes = shown_plane_bytes(shape.cells.size());
    if (Status status = expand_zstd_frame(coded.shown, plane_bytes, kShownName, plane); !status) return status;
    if (Status status = put_shown(plane, shape); !status) return status;
    const std::uint64_t found = surfaces_of(shape);
    if (found != coded.surfaces) {
        return Error{"claims " + std::to_string(coded.surfaces) + " cells with a surface, but its bits show " +
                     std::to_string(found)};
    }
    if (Status status = expand_zstd_frame(coded.residuals, coded.surfaces, kResidualsName, plane); !status) {
        return status;
    }
    put_residuals(plane, shape);
    return {};
}

}  // namespace rs::object_chunks
