#pragma once
// The depth of a rendered view as the tools write it: like a tracer's depth channel, in the units of the object's rig.

#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>

namespace rs::engine {

// `lambda_q20` is Renderer::render's for the view of `camera`. Axial depth from the camera's own centre, also where
// prepare_view brought a distant viewpoint nearer; 0 where nothing is shown.
Image<float> depth_image(const RaySpaceObject& object, const Camera& camera, ConstImageView<std::int32_t> lambda_q20);

}  // namespace rs::engine
