#pragma once
// Lights of which nothing will be seen. Pure; thread-safe.

#include "compositor/scene/scene.hpp"

#include <string>
#include <vector>

namespace rs::compositor {

// "light 3 'desk lamp' ...", a line for each light that has no power, or that stands inside of a solid: where the
// winding number (A. Jacobson and others, "Robust Inside-Outside Segmentation Using Generalized Winding Numbers", 2013)
// of a part of the geometry that is seen from outside only is above one half, so that rooms, which are seen from
// inside, are none. Parts of more than half a million triangles are not tested.
std::vector<std::string> light_warnings(const Scene& scene);

// Of one light of the scene, or nothing.
std::string light_warning(const Scene& scene, std::size_t light);

}  // namespace rs::compositor
