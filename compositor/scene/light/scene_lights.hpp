#pragma once
// Conversion between a scene's lights and light lists. Pure; thread-safe.

#include "compositor/scene/light/lights_file.hpp"
#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

namespace rs::compositor {

/// All current lights as a list with "replace", which reproduces the scene's lighting when loaded. Lights from lists
/// keep their entries. Lights that are not finite are omitted.
LightList lights_as_list(const Scene& scene);

/// Adds a list's lights to the scene, or replaces its own. Fails, with the scene unchanged, if a "scope" does not exist
/// in the scene.
/// \param from name of the list for errors.
Status add_lights(Scene& scene, LightList list, const std::string& from);

}  // namespace rs::compositor
