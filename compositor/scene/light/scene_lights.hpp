#pragma once
// Conversion between a scene's lights and light lists, and to the lights that are rasterized. Pure; thread-safe.

#include "compositor/scene/light/lights_file.hpp"
#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/light/light.hpp"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace rs::compositor {

/// All current lights as a list with "replace", which reproduces the scene's lighting when loaded. Lights from lists
/// keep their entries. Lights that are not finite are omitted.
LightList lights_as_list(const Scene& scene);

/// Adds a list's lights to the scene, or replaces its own. Fails, with the scene unchanged, if a "scope" does not exist
/// in the scene.
/// \param from name of the list for errors.
Status add_lights(Scene& scene, LightList list, const std::string& from);

/// Estimated interreflection of area lights, luminaires, and points and spots in candela, which have no ambient part:
/// that of a closed sphere with the surface of the geometry's box and reflectance r = 1/2, whose walls receive flux * r
/// / (surface * (1 - r)) in addition to direct light.
/// \return radiance of a white surface.
glm::vec3 reflected_light(const Scene& scene);

/// [light] True for lights that cast shadows. Of the directional lights that illuminate a node by scope only the
/// brightest does: the others model light reflected by walls. Lights without colour, and those whose `casts_shadows` is
/// false, cast none.
std::vector<bool> lights_with_shadows(const Scene& scene);

/// Punctual lights (rayspace/light/light.hpp), in number and order of Scene::lights, scaled by 2^exposure_ev; then one
/// for reflected_light(). Without the environment, which irradiance_harmonics.hpp projects.
std::vector<Light> raster_lights(const Scene& scene, double exposure_ev);

}  // namespace rs::compositor
