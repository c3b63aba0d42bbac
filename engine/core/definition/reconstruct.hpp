#pragma once
// Scalar definition: implements engine/RECONSTRUCTION.md pixel by pixel, from the stored Y, U, V and alpha. Slow and
// simple; every other implementation must equal it bit for bit.

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>

namespace rs::engine {

/// Renders a view. All images of the ring must be loaded.
/// \param out         size of the view
/// \param lambda_q20  empty, or the size of the view: receives the axial depth in object radii, from the viewpoint of
///                    `registers` along the viewing axis; 0 where alpha is 0. An object without a shape map is
///                    assumed to lie on its reference planes.
void reconstruct_scalar(const RaySpaceObject& object, const ViewRegisters& registers, ImageView<Rgba8> out,
                        ImageView<std::int32_t> lambda_q20 = {});

}  // namespace rs::engine
