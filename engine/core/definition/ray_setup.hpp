#pragma once
// Sections 2 and 3 of engine/RECONSTRUCTION.md: maps a pixel of the view to a column of a captured image and the rows
// along it. Shared by the scalar definition and the fast core.

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>

namespace rs::engine {

/// Intersection of a view ray with its reference plane (section 2 of engine/RECONSTRUCTION.md).
struct PlanePoint {
    bool exists = false;
    int plane = 0;
    std::int64_t n_q28 = 0;       // component of the direction against the normal
    std::int64_t t_q28 = 0;       // component of the direction along the tangent
    std::int64_t u_q28 = 0;       // tangent of the angle to the normal
    std::int64_t x_q20 = 0;       // position along the tangent, object radii
    std::int64_t lambda_q20 = 0;  // axial distance to the plane
};

PlanePoint plane_point(const Ring& ring, const ViewRegisters& registers, int i, int j);

/// Looks up the ray in the RS map. \return index of a view, or kNoImage
std::uint16_t look_up_rs_map(const Ring& ring, const PlanePoint& point);

struct RaySetup {
    int image = -1;  // -1: no ray
    int column = 0;
    std::int64_t row_0_q16 = 0;
    std::int64_t row_step_q16 = 0;
    std::int32_t lambda_q20 = 0;  // axial depth of the reference plane

    /// Row of the captured image for view row j; may lie outside of the image.
    [[nodiscard]] std::int64_t row(int j) const { return (row_0_q16 + j * row_step_q16) >> 16; }
};

/// Computes the set-up of pixel (i, j); `registers` was prepared for `object`; 0 <= i < width, 0 <= j < height. In an
/// upright view the result is the same for every j.
RaySetup set_up_ray(const RaySpaceObject& object, const ViewRegisters& registers, int i, int j);

/// Rows begin .. end - 1 of a view.
struct ViewRows {
    std::int32_t begin = 0;
    std::int32_t end = 0;
};

/// Rows j of a view of `height` rows for which ray.row(j) is in [first, end): one interval, since ray.row is linear.
ViewRows rows_within(const RaySetup& ray, std::int32_t first, std::int32_t end, int height);

}  // namespace rs::engine
