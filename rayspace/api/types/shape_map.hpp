#pragma once
/// \file
/// The RS map with height: at what depth the two captured rays that answer a view ray meet it.
///
/// The paper's RS map has one depth per object, the reference plane's. Here ray space gets its third dimension, height:
/// for every ray of a vertical plane (two numbers) and every band of height there is a cell that states how far along
/// the ray the surface is.
///
/// A *gap* is the piece of ray space between two neighbouring views of a ring, `first` and `second` in turning order.
/// It is sampled along `lines`: line s of S lies at the fraction (s + 1/2) / S between the two captured lines. A ray of
/// a vertical plane is met at its *foot*, the point nearest to the axis. Of a line, cells are laid out by p, the signed
/// distance of the ray from the axis, and by h, the height at which the ray passes the foot:
///
///     cells[(line * p_cells + pi) * bands + hi],  line = first_line of the gap + s
///     pi = floor((p + p_half) * p_cells_per_unit)       clamped to the cells
///     hi = floor((h - h_low) * bands_per_unit)          outside: no surface
///
/// h is that of a ray from the ring's own distance and height (`reference`); for a ray of another slope the engine
/// follows the surface to the reference ray that sees the same point (engine/RECONSTRUCTION.md).
///
/// A cell holds one surface, which both images show or one of them: depth d means depth_low + d * depth_step along
/// the ray from the foot, away from the viewer. Cells are samples at their middles: between neighbouring cells, in p,
/// in height and from line to line, the engine interpolates where their depths differ by at most `jump`. A ray of
/// another slope that passes less than `thickness` behind the deepest cell around it meets the object all the same.
///
/// Lengths are in object radii; everything is integer. Stored as in encode/FORMAT.md, chunk `shap`.

#include <cstdint>
#include <vector>

namespace rs {

/// Surface of one cell.
struct ShapeCell {
    std::uint8_t depth = 0;  ///< in depth steps from depth_low
    /// The gap's photos that show the surface: kByFirst, kBySecond or kByBoth. 0: no surface, and depth is 0.
    std::uint8_t shown = 0;

    static constexpr std::uint8_t kByFirst = 1;                    ///< shown by the first photo of the gap
    static constexpr std::uint8_t kBySecond = 2;                   ///< shown by the second photo of the gap
    static constexpr std::uint8_t kByBoth = kByFirst | kBySecond;  ///< shown by both photos

    /// True if the cell holds a surface.
    [[nodiscard]] bool has_surface() const { return shown != 0; }

    bool operator==(const ShapeCell&) const = default;  ///< equal in all members
};

/// Complements a CapturedLine for points beside the reference plane: with z along the plane's normal, towards the
/// viewer, the point (x, z) is at axial depth l0 + x l1 + z l2 and at column cx + (q0 + x q1 + z q2) / l.
struct NormalLine {
    std::int32_t l2_q30 = 0;  ///< l2
    std::int32_t q2_q16 = 0;  ///< q2, px
    std::int32_t a_q20 = 0;   ///< position of the camera along the plane's tangent (RECONSTRUCTION.md, equation 1)
    std::int32_t c_q20 = 0;   ///< position of the camera along the plane's normal
    bool operator==(const NormalLine&) const = default;  ///< equal in all members
};

/// Gap between view n of the ring and view n + 1, or between the last view and view 0.
struct ShapeGap {
    std::uint16_t lines = 0;       ///< S; 0: the sector has no depth, its rays show the nearest photo
    std::uint32_t first_line = 0;  ///< sum of `lines` of the gaps before
    bool operator==(const ShapeGap&) const = default;  ///< equal in all members
};

/// Shape map of a ring; the formulas are in the description of this file.
struct ShapeMap {
    int p_cells = 0;                          ///< cells along p
    int bands = 0;                            ///< cells along h
    std::int32_t p_half_q20 = 0;              ///< the map covers |p| <= p_half
    std::int32_t p_cells_per_unit_q12 = 0;    ///< cells of p per object radius
    std::int32_t h_low_q20 = 0;               ///< lower end of h
    std::int32_t bands_per_unit_q12 = 0;      ///< cells of h per object radius
    std::int32_t reference_distance_q20 = 0;  ///< distance of the reference viewpoints from the axis
    std::int32_t reference_height_q20 = 0;    ///< Y of the reference viewpoints
    std::int32_t depth_low_q20 = 0;           ///< distance from the foot of the ray at depth 0
    std::int32_t depth_step_q24 = 0;          ///< length of a depth step
    int jump = 0;                             ///< 1..255, depth steps
    int thickness = 0;                        ///< 0..255, depth steps
    std::vector<ShapeGap> gaps;               ///< [n], one per view of the ring
    std::vector<NormalLine> normal_lines;     ///< [n * planes + k]
    std::vector<ShapeCell> cells;             ///< [(line * p_cells + pi) * bands + hi]

    /// True if the ring has no shape map.
    [[nodiscard]] bool empty() const { return gaps.empty(); }
    bool operator==(const ShapeMap&) const = default;  ///< equal in all members
};

}  // namespace rs
