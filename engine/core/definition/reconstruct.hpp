#pragma once
// The scalar definition: engine/RECONSTRUCTION.md written down pixel by pixel, from the stored Y, U, V and alpha. Slow
// and plain; whatever is faster must equal it.

#include "engine/core/definition/view_registers.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>

namespace rs::engine {

// `out` has the view's size. All images of the ring must be loaded. `lambda_q20`, where not empty, has that size too
// and receives the axial depth of what is shown: object radii from the viewpoint that `registers` hold, along the
// viewing axis; 0 where alpha is 0. An object without a shape map lies on its reference planes.
void reconstruct_scalar(const RaySpaceObject& object, const ViewRegisters& registers, ImageView<Rgba8> out,
                        ImageView<std::int32_t> lambda_q20 = {});

}  // namespace rs::engine
