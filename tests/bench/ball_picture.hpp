#pragma once
// A picture that codecs have something to do with.

#include "rayspace/geometry/camera.hpp"
#include "rayspace/image/image.hpp"

namespace rs::bench {

// A ball with fine and coarse texture, lit from a side, that fills most of the picture.
Image<Rgba8> ball_picture(const Camera& camera);

}  // namespace rs::bench
