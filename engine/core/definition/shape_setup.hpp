#pragma once
// Section 5 of engine/RECONSTRUCTION.md: brackets a view ray of an object with a shape map by two captured rays and
// computes the coefficients of everything that is linear in the cell's depth d. Shared by the scalar definition and the
// fast core; in an upright view one set-up serves a whole column.

#include "engine/core/definition/shape_cells.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>

namespace rs::engine {

// Projection of the view ray into a captured image. At depth d_q3, eighths of a step: axial depth
// l = l0 + (d_q3 * l1 >> 7), lateral offset times focal length n = n0 + (d_q3 * n1 >> 3).
struct ShapeImage {
    std::int32_t view = -1;
    std::int32_t l0_q20 = 0;
    std::int32_t l1_q24 = 0;
    std::int32_t n0_q12 = 0;
    std::int32_t n1_q12 = 0;
};

struct ShapeSetup {
    bool has_ray = false;
    ShapeImage first;
    ShapeImage second;
    std::int32_t weight = 0;           // of the second image, 0..256
    CellColumns cells;                 // null columns: no shape, and d = 0 is the foot
    std::int32_t foot_depth_q3 = 0;    // depth of the foot
    std::int32_t lambda_foot_q20 = 0;  // axial depth of the foot in the view
    std::int32_t lambda0_q20 = 0;      // axial depth at depth d_q3: lambda0 + (d_q3 * lambda1 >> 4)
    std::int32_t lambda1_q21 = 0;
    std::int32_t inverse_r_q20 = 0;    // 1 / horizontal length of the ray's direction
    std::int32_t inverse_rho_q20 = 0;  // 1 / distance from the reference viewpoint to the foot

    [[nodiscard]] bool has_shape() const { return cells.at[0][0] != nullptr; }
};

/// Computes the set-up of pixel (i, j); `registers` was prepared for `object`, whose ring has a shape map;
/// 0 <= i < width, 0 <= j < height. In an upright view the result is the same for every j.
ShapeSetup set_up_shape(const RaySpaceObject& object, const ViewRegisters& registers, int i, int j);

}  // namespace rs::engine
