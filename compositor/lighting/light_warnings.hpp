#pragma once
// Detects lights without a visible effect. Pure; thread-safe.

#include "compositor/scene/scene.hpp"

#include <string>
#include <vector>

namespace rs::compositor {

// One line, "light 3 'desk lamp' ...", per light that has no power or is inside a solid, i.e. where the winding number
// (A. Jacobson et al., "Robust Inside-Outside Segmentation Using Generalized Winding Numbers", 2013) of a one-sided
// part of the geometry exceeds one half. Rooms, whose front sides face inwards, are not solids. Parts of more than half
// a million triangles are not tested.
std::vector<std::string> light_warnings(const Scene& scene);

// Warning for one light of the scene, or an empty string.
std::string light_warning(const Scene& scene, std::size_t light);

}  // namespace rs::compositor
