#pragma once
// Test image for codecs.

#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

namespace rs::bench {

// Ball with fine and coarse texture, lit from the side, that fills most of the image.
Image<Rgba8> ball_image(const Camera& camera);

}  // namespace rs::bench
