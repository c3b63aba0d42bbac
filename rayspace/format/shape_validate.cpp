#include "rayspace/format/shape_validate.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/format/shape_chunk.hpp"

#include <string>

namespace rs {

using namespace object_ranges;

namespace {

constexpr std::int32_t kMaxBandsPerUnit_q12 = 1 << 26;
constexpr std::int32_t kMaxDepthStep_q24 = 1 << 18;

bool is_within(std::int32_t number, std::int64_t lowest, std::int64_t highest) {
    return number >= lowest && number <= highest;
}

Status check_numbers(const ShapeMap& shape) {
    const auto is_side = [](int side) { return side >= 1 && side <= kMaxMapSide; };
    if (!is_side(shape.p_cells) || !is_side(shape.bands)) {
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
    // |l2| <= 1: it is the cosine of an angle.
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
        if (gap.lines > object_chunks::kMaxGapLines) {
            return Error{"gap " + std::to_string(n) + " has " + std::to_string(gap.lines) + " lines; 0.." +
                         std::to_string(object_chunks::kMaxGapLines) + " are possible"};
        }
        if (gap.first_line != lines) return Error{"gap " + std::to_string(n) + " does not begin behind its forerunner"};
        lines += gap.lines;
    }
    const std::uint64_t cells =
        lines * static_cast<std::uint64_t>(shape.p_cells) * static_cast<std::uint64_t>(shape.bands);
    if (cells > object_chunks::kMaxShapeCells) {
        return Error{"it has " + std::to_string(cells) + " cells; at most " +
                     std::to_string(object_chunks::kMaxShapeCells) + " are possible"};
    }
    if (shape.cells.size() != cells) return Error{"it does not have as many cells as its sizes say"};
    return {};
}

// What does not exist is 0, so that equal maps are equal in memory and the file need not hold it.
Status check_cell(const ShapeCell& cell) {
    if (!cell.has_surface() && cell.depth != 0) return Error{"has a depth and no surface"};
    if (cell.shown > ShapeCell::kByBoth) return Error{"is shown by pictures that its gap does not have"};
    return {};
}

}  // namespace

Status check_shape(const Ring& ring) {
    const ShapeMap& shape = ring.shape;
    if (shape.empty()) return shape == ShapeMap{} ? Status{} : Status{Error{"it has no gaps and yet numbers or cells"}};
    if (Status status = check_numbers(shape); !status) return status;
    if (Status status = check_gaps(ring); !status) return status;
    if (shape.normal_lines.size() != ring.views.size() * static_cast<std::size_t>(ring.planes)) {
        return Error{"it does not have one normal line per view and plane"};
    }
    for (const NormalLine& line : shape.normal_lines) {
        if (Status status = check_normal_line(line); !status) return status;
    }
    for (std::size_t i = 0; i < shape.cells.size(); ++i) {
        if (const Status status = check_cell(shape.cells[i]); !status) {
            return Error{"cell " + std::to_string(i) + " " + status.error().message};
        }
    }
    return {};
}

}  // namespace rs
