#pragma once
// A scene's lights as a list, and a list's lights in a scene. Pure; thread-safe.

#include "compositor/scene/light/lights_file.hpp"
#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

namespace rs::compositor {

// All lights in force, as a list that replaces them: put into the scene's file again, it gives the same light. What
// came from lists keeps its words. Lights that are not finite are left out.
LightList lights_in_force(const Scene& scene);

// Lights the scene by a list: beside its own lights or in their place. Refuses, with the scene as it was, a "scope"
// that the scene does not have; `from` names the list.
Status add_lights(Scene& scene, LightList list, const std::string& from);

}  // namespace rs::compositor
