#pragma once
// A scene's lights as OpenGL draws by them.

#include "compositor/scene/scene.hpp"

#include <vector>

namespace rs::compositor {

// What walls reflect of areas, luminaires, and points and spots of so many candelas, which bring no ambient part along:
// as in a closed sphere of the surface of the geometry's box and reflectance 1/2, whose walls get
// flux * r / (surface * (1 - r)) beyond the direct light. What a white surface shows of it.
glm::vec3 reflected_light(const Scene& scene);

// Punctual ones (rayspace/light/light.hpp), as many and in the order of Scene::lights, 2^exposure_ev times as bright.
// One light more stands for reflected_light(), one for the environment, as its mean.
std::vector<Light> raster_lights(const Scene& scene, double exposure_ev);

}  // namespace rs::compositor
