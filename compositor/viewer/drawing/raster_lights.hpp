#pragma once
// A scene's lights as OpenGL draws by them.

#include "compositor/scene/scene.hpp"

#include <vector>

namespace rs::compositor {

// Punctual ones (rayspace/light/light.hpp), as many and in the order of Scene::lights, 2^exposure_ev times as bright.
// Where there are areas or luminaires, which bring no ambient part along, one light more stands for what walls reflect
// of them: as in a closed sphere of the surface of the geometry's box and reflectance r, whose walls get
// flux * r / (surface * (1 - r)) beyond the direct light. One more stands for the environment, as its mean.
std::vector<Light> raster_lights(const Scene& scene, double exposure_ev);

}  // namespace rs::compositor
