#pragma once
// Section 2 of engine/RECONSTRUCTION.md: the reference plane of a view ray, and the ray's place (x, u) on it.

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>

namespace rs::engine {

struct PlanePoint {
    bool exists = false;
    int plane = 0;
    std::int64_t n_q28 = 0;  // the direction's components against the normal and along the tangent
    std::int64_t t_q28 = 0;
    std::int64_t u_q28 = 0;
    std::int64_t x_q20 = 0;
    std::int64_t lambda_q20 = 0;  // axial distance to the plane
};

PlanePoint plane_point(const Ring& ring, const ViewRegisters& registers, int i, int j);

// What the RS map says of the ray: a view, or kNoPicture.
std::uint16_t map_answer(const Ring& ring, const PlanePoint& point);

}  // namespace rs::engine
