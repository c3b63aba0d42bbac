#pragma once
// Computes the registers of a view (rayspace/api/types/view_registers.hpp) from a camera.

#include "rayspace/api/types/view_registers.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/object/ray_space_object.hpp"

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

/// Validates registers that prepare_view did not compute: sizes, ring, number of planes, and the ranges of
/// RECONSTRUCTION.md at every pixel. Renderers require valid registers and do not check them.
Status check_registers(const RaySpaceObject& object, const ViewRegisters& registers);

/// Viewpoint of prepare_view in object radii: the camera's centre, moved to at most 200 radii.
glm::dvec3 prepared_viewpoint(const RaySpaceObject& object, const Camera& camera);

}  // namespace rs::engine
