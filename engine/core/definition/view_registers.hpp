#pragma once
// The integers of one view, made from a camera: the input of the normative arithmetic (engine/RECONSTRUCTION.md,
// section 1), what a driver writes into the registers of a board.

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <vector>

namespace rs::engine {

// A quantity that is linear over the view: value of pixel (i, j) = at_origin + i * per_column + j * per_row, all q32.
struct LinearForm {
    std::int64_t at_origin = 0;
    std::int64_t per_column = 0;
    std::int64_t per_row = 0;
    [[nodiscard]] std::int64_t at(int i, int j) const { return at_origin + i * per_column + j * per_row; }
};

struct PlaneRegisters {
    std::int32_t a_q20 = 0;    // the viewpoint along the plane's tangent
    std::int32_t c_q20 = 0;    // and along its normal
    LinearForm along_normal;   // direction . normal
    LinearForm along_tangent;  // direction . tangent
};

struct ViewRegisters {
    int width = 0;   // px
    int height = 0;  // px
    int ring = 0;
    std::int32_t b_q20 = 0;  // the viewpoint's height
    LinearForm rise;         // direction . Y
    std::vector<PlaneRegisters> planes;

    // Of pixel (i, j), as rendering with height takes it.
    [[nodiscard]] std::int32_t rise_q24(int i, int j) const { return static_cast<std::int32_t>(rise.at(i, j) >> 8); }

    // True where a column of the view is a vertical plane of rays, so that one set-up serves a column.
    [[nodiscard]] bool upright() const;
};

// `camera` is in the units of the object's rig (RaySpaceObject::units_per_radius). A viewpoint farther than 200 radii
// is brought to 200 with the field of view narrowed so that the object's picture stays the same. Fails, naming the
// quantity, where the camera leaves the ranges of RECONSTRUCTION.md: sizes of 1..8192 px, focal length above 0 and wide
// enough, finite numbers. Pure; thread-safe.
Result<ViewRegisters> prepare_view(const RaySpaceObject& object, const Camera& camera);

// Whether registers from elsewhere are such as prepare_view makes for this object: sizes, ring, number of planes, and
// the ranges of RECONSTRUCTION.md at every pixel. Renderers do not check again.
Status check_registers(const RaySpaceObject& object, const ViewRegisters& registers);

// The viewpoint that prepare_view takes, in object radii: the camera's centre, or where it was brought to.
glm::dvec3 prepared_viewpoint(const RaySpaceObject& object, const Camera& camera);

}  // namespace rs::engine
