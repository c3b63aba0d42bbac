#pragma once
// Conversion of a scene's lights for rasterisation.

#include "compositor/scene/scene.hpp"

#include <vector>

namespace rs::compositor {

/// Estimated interreflection of area lights, luminaires, and points and spots in candela, which have no ambient part:
/// that of a closed sphere with the surface of the geometry's box and reflectance r = 1/2, whose walls receive flux * r
/// / (surface * (1 - r)) in addition to direct light.
/// \return radiance of a white surface.
glm::vec3 reflected_light(const Scene& scene);

/// Punctual lights (rayspace/light/light.hpp), in number and order of Scene::lights, scaled by 2^exposure_ev; then one
/// for reflected_light() and one for the mean of the environment.
std::vector<Light> raster_lights(const Scene& scene, double exposure_ev);

}  // namespace rs::compositor
