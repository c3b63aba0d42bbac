#pragma once
// An image that codecs have something to do with.

#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

namespace rs::bench {

// A ball with fine and coarse texture, lit from a side, that fills most of the image.
Image<Rgba8> ball_image(const Camera& camera);

}  // namespace rs::bench
