#pragma once
// The scalar definition: engine/RECONSTRUCTION.md written down pixel by pixel, from the stored Y, U, V and alpha. Slow
// and plain; whatever is faster must equal it.

#include "engine/core/view_registers.hpp"
#include "rayspace/image.hpp"
#include "rayspace/ray_space_object.hpp"

namespace rs::engine {

// `out` has the view's size. All pictures of the ring must be loaded.
void reconstruct_scalar(const RaySpaceObject& object, const ViewRegisters& registers, ImageView<Rgba8> out);

}  // namespace rs::engine
