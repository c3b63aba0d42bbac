#pragma once
// Normal maps in the tangent frame of the texture coordinates. Pure; thread-safe.

#include "compositor/scene/material.hpp"
#include "rayspace/image/image.hpp"

#include <memory>

namespace rs::compositor {

/// One direction of any length per texel: r along s, g along t, b away from the surface; a is 1. (0, 0, 1) keeps the
/// surface's normal bit for bit. Interpolated between texels, then normalised.
struct NormalMap {
    std::filesystem::path file;  // as SceneTexture::file
    Image<RgbaF> directions;     // the first row is the top, at the largest t
    bool repeat_s = true;
    bool repeat_t = true;
};

/// Converts a glTF 2.0 normal texture (3.9.3): bytes 1, 128, 255 are -1, 0, 1.
/// \param scale factor on r and g.
std::shared_ptr<const NormalMap> normal_map(const SceneTexture& image, float scale);

/// Converts a height image (its luminance; MTL's bump map) with the Sobel operator.
/// \param multiplier MTL's -bm: a step from black to white between two columns gives a slope of 4 at both.
std::shared_ptr<const NormalMap> normal_map_of_heights(const SceneTexture& image, float multiplier);

}  // namespace rs::compositor
