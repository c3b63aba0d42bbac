#pragma once
// The integers of one view, made from a camera: the input of the normative arithmetic (engine/RECONSTRUCTION.md,
// section 1), what a driver writes into the registers of a board.

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <optional>
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

/// How a ring with a shape map samples its images (engine/RECONSTRUCTION.md, section 7). Rings without one fetch the
/// nearest pixel.
enum class TexelFilter : std::uint8_t {
    kBilinear = 0,
    kSharp = 1,   // bilinear plus luma detail: close to bicubic
    kSmooth = 2,  // bilinear minus luma detail: a low-pass filter for views smaller than the images
};

struct ViewRegisters {
    int width = 0;   // px
    int height = 0;  // px
    int ring = 0;
    TexelFilter filter = TexelFilter::kBilinear;  // ignored by rings without a shape map
    std::int32_t b_q20 = 0;                       // the viewpoint's height
    LinearForm rise;                              // direction . Y
    std::vector<PlaneRegisters> planes;

    // Of pixel (i, j), as rendering with height takes it.
    [[nodiscard]] std::int32_t rise_q24(int i, int j) const { return static_cast<std::int32_t>(rise.at(i, j) >> 8); }

    // True where a column of the view is a vertical plane of rays, so that one set-up serves a column.
    [[nodiscard]] bool upright() const;
};

/// Computes the registers of a view. A viewpoint farther than 200 radii is moved to 200, with the field of view
/// narrowed so that the object's image stays the same. Pure; thread-safe.
/// \param camera  in the units of the object's rig (RaySpaceObject::units_per_radius)
/// \param filter  the default depends on the object's size in the view relative to the captured images: sharp from
///                0.95, smooth up to 0.75, else bilinear
/// \return        an error that names the quantity where the camera leaves the ranges of RECONSTRUCTION.md: sizes of
///                1..8192 px, focal length above 0 and wide enough, finite numbers
Result<ViewRegisters> prepare_view(const RaySpaceObject& object, const Camera& camera,
                                   std::optional<TexelFilter> filter = {});

// Whether registers from elsewhere are such as prepare_view makes for this object: sizes, ring, number of planes, and
// the ranges of RECONSTRUCTION.md at every pixel. Renderers do not check again.
Status check_registers(const RaySpaceObject& object, const ViewRegisters& registers);

// The viewpoint that prepare_view takes, in object radii: the camera's centre, or where it was brought to.
glm::dvec3 prepared_viewpoint(const RaySpaceObject& object, const Camera& camera);

}  // namespace rs::engine
