#pragma once
// Depth image of a rendered view in the units of the object's rig, like the tracer's depth channel.

#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>

namespace rs::engine {

/// Axial depth from the camera's centre, also if prepare_view moved a distant viewpoint nearer; 0 where alpha is 0.
/// \param lambda_q20  from Renderer::render for the view of `camera`
Image<float> depth_image(const RaySpaceObject& object, const Camera& camera, ConstImageView<std::int32_t> lambda_q20);

}  // namespace rs::engine
