#pragma once
// Prefiltered reflections of distant surroundings: the first factor of the split-sum approximation (B. Karis, Real
// Shading in Unreal Engine 4, SIGGRAPH 2013 course notes). Maps are latitude-longitude images of radiance as in
// EnvironmentLight, with scale 1 and not rotated. Pure; thread-safe.

#include "rayspace/image/image.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace rs::compositor {

/// Number of prefiltered levels; level i has roughness i / (kReflectionLevels - 1).
inline constexpr int kReflectionLevels = 7;
inline constexpr int kReflectionWidth = 512;  // of level 0, px
inline constexpr int kReflectionHeight = 256;

/// Unit direction through position (x, y) of a map of `size`, px.
glm::vec3 direction_in_map(const glm::vec2& position, const glm::ivec2& size);

/// Radiance at a position of a map, whose width and height are 1. Bilinear; repeats in u.
glm::vec3 radiance_in_map(const Image<RgbaF>& map, const glm::vec2& uv);

/// Means of the GGX lobes of isotropic reflection, seen along the lobe's axis. Some 50 ms.
/// \param radiance kReflectionWidth x kReflectionHeight; becomes level 0
/// \return kReflectionLevels images, each of half the size of the previous one
std::vector<Image<RgbaF>> prefilter_reflections(Image<RgbaF> radiance);

}  // namespace rs::compositor
