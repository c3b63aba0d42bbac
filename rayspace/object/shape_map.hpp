#pragma once
// Shape map: the RS map with height, which adds a depth to every cell of ray space.
//
// The paper's RS map has one depth, that of the reference plane. Here ray space has its third dimension, height: for
// every ray of a vertical plane (two numbers) and every band of height a cell contains the depth of the surface along
// the ray.
//
// A *gap* is the part of ray space between two neighbouring views of a ring, `first` and `second` in turning order.
// It is sampled along `lines`: line s of S is at the fraction (s + 1/2) / S between the two captured lines. The
// *foot* of a ray of a vertical plane is its point nearest to the axis. The cells of a line are indexed by p, the
// signed distance of the ray from the axis, and by h, the height at which the ray passes the foot:
//
//     cells[(line * p_cells + pi) * bands + hi],  line = first_line of the gap + s
//     pi = floor((p + p_half) * p_cells_per_unit)       clamped to the cells
//     hi = floor((h - h_low) * bands_per_unit)          outside: no surface
//
// h refers to a ray from the ring's own distance and height (`reference`); for a ray of another slope the engine
// follows the surface to the reference ray through the same point (engine/RECONSTRUCTION.md).
//
// A cell contains one surface, shown by one or both images: depth d means depth_low + d * depth_step along the ray
// from the foot, away from the viewer. Cells are samples at their centres: between neighbouring cells, in p, in
// height and from line to line, the engine interpolates if their depths differ by at most `jump`. A ray of another
// slope that passes less than `thickness` behind the deepest cell around it also hits the object.
//
// Lengths are in object radii; all values are integers. Stored as in encode/FORMAT.md, chunk `shap`.

#include <cstdint>
#include <vector>

namespace rs {

struct ShapeCell {
    std::uint8_t depth = 0;
    // Images of the gap that show the surface: kByFirst, kBySecond or kByBoth. 0: no surface, and depth is 0.
    std::uint8_t shown = 0;

    static constexpr std::uint8_t kByFirst = 1, kBySecond = 2, kByBoth = kByFirst | kBySecond;

    [[nodiscard]] bool has_surface() const { return shown != 0; }

    bool operator==(const ShapeCell&) const = default;
};

/// Extension of a captured line (CapturedLine) to points beside its reference plane: with z along the plane's normal,
/// towards the viewer, the point (x, z) is at axial depth l0 + x l1 + z l2 and at column cx + (q0 + x q1 + z q2) / l.
/// (a, c) is the camera's position in the plane's frame (equation 1).
struct NormalLine {
    std::int32_t l2_q30 = 0;
    std::int32_t q2_q16 = 0;
    std::int32_t a_q20 = 0;
    std::int32_t c_q20 = 0;
    bool operator==(const NormalLine&) const = default;
};

/// The gap between view n and view n + 1 of the ring (or view 0 after the last).
struct ShapeGap {
    std::uint16_t lines = 0;       // S; 0: unknown sector, whose rays show the nearest image
    std::uint32_t first_line = 0;  // sum of `lines` of the previous gaps
    bool operator==(const ShapeGap&) const = default;
};

struct ShapeMap {
    int p_cells = 0;
    int bands = 0;
    std::int32_t p_half_q20 = 0;
    std::int32_t p_cells_per_unit_q12 = 0;
    std::int32_t h_low_q20 = 0;
    std::int32_t bands_per_unit_q12 = 0;
    std::int32_t reference_distance_q20 = 0;  // distance from the axis
    std::int32_t reference_height_q20 = 0;
    std::int32_t depth_low_q20 = 0;
    std::int32_t depth_step_q24 = 0;
    int jump = 0;                          // 1..255, depth steps
    int thickness = 0;                     // 0..255, depth steps
    std::vector<ShapeGap> gaps;            // [n], one per view of the ring
    std::vector<NormalLine> normal_lines;  // [n * planes + k]
    std::vector<ShapeCell> cells;

    [[nodiscard]] bool empty() const { return gaps.empty(); }
    bool operator==(const ShapeMap&) const = default;
};

}  // namespace rs
