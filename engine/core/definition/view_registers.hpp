#pragma once
// Computes the registers of a view (rayspace/api/types/view_registers.hpp) from a camera, and the depth image of the
// camera from the depths that a view of these registers gives.

#include "rayspace/api/types/view_registers.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <optional>

namespace rs::engine {

/// Computes the registers of a view. A viewpoint farther than 200 radii is moved to 200, with the field of view
/// narrowed so that the object's image stays the same. Pure; thread-safe.
/// \param camera  in the units of the object's rig (RaySpaceObject::units_per_radius)
/// \param filter  the default depends on the object's size in the view relative to the captured images: sharp from
///                0.95, smooth up to 0.75, else bilinear
/// \return        an error that names the quantity where the camera leaves the ranges of RECONSTRUCTION.md: sizes of
///                1..8192 px, focal length above 0 and wide enough, finite numbers
Result<ViewRegisters> prepare_view(const RaySpaceObject& object, const Camera& camera,
                                   std::optional<TexelFilter> filter = {});

/// A view that is mixed from the images of two rings (mix_rings.hpp) where the viewpoint lies between them.
struct MixedView {
    ViewRegisters nearest;
    std::optional<ViewRegisters> second;
    int weight_q8 = 0;  // of the second ring, 1..128; 0: there is none
};

/// As prepare_view(), which uses the nearest ring alone.
Result<MixedView> prepare_mixed_view(const RaySpaceObject& object, const Camera& camera,
                                     std::optional<TexelFilter> filter = {});

/// Validates registers that prepare_view did not compute: sizes, ring, number of planes, and the ranges of
/// RECONSTRUCTION.md at every pixel. Renderers require valid registers and do not check them.
Status check_registers(const RaySpaceObject& object, const ViewRegisters& registers);

/// Axial depth from the centre of a camera, in the units of the object's rig:
/// float((lambda_q20 * 2^-20 + to_viewpoint) * units_per_radius), computed in double precision.
struct DepthScale {
    double to_viewpoint = 0;  // from the camera's centre, object radii: prepare_view moves distant viewpoints nearer
    double units_per_radius = 1;
};
DepthScale depth_scale(const RaySpaceObject& object, const Camera& camera);

/// Depth image of a rendered view in the units of the object's rig, like the tracer's depth channel: axial depth from
/// the camera's centre, also if prepare_view moved a distant viewpoint nearer; 0 where alpha is 0.
/// \param lambda_q20  from Renderer::render for the view of `camera`
Image<float> depth_image(const RaySpaceObject& object, const Camera& camera, ConstImageView<std::int32_t> lambda_q20);

}  // namespace rs::engine
