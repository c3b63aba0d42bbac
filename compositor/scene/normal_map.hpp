#pragma once
// Small relief on a surface: normals, in the frame of its texture coordinates, in place of its own. Pure; thread-safe.

#include "compositor/scene/material.hpp"
#include "rayspace/image/image.hpp"

#include <memory>

namespace rs::compositor {

// Per texel a direction, of any length: r along s, g along t, b away from the surface; a is 1. (0, 0, 1) leaves the
// surface's normal as it is, bit for bit. Interpolated between texels, then normalised.
struct NormalMap {
    Image<RgbaF> directions;  // the first row is the top, where t is largest
    bool repeat_s = true;
    bool repeat_t = true;
};

// Of an image of directions as glTF 2.0 has them (3.9.3): bytes 1, 128, 255 are -1, 0, 1. `scale` is that of r and g.
std::shared_ptr<const NormalMap> normal_map(const SceneTexture& image, float scale);

// Of an image of heights (its luminance; MTL's bump map): slopes by I. Sobel's operator, as image tools have them,
// times `multiplier` (-bm): a step from black to white between columns is a slope of 4 on both of them.
std::shared_ptr<const NormalMap> normal_map_of_heights(const SceneTexture& image, float multiplier);

}  // namespace rs::compositor
