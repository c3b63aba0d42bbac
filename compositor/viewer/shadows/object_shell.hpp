#pragma once
// Approximate surface mesh of an image-based object for shadow casting, merged from engine views with depth around the
// object at the elevations of its capture. Lights can then come from any direction, including from above, where no
// image was taken and the engine has no view.

#include "compositor/viewer/residency/placed_object.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rs::compositor {

struct ObjectShell {
    std::vector<glm::vec3> corners;  // in object radii
    std::vector<std::uint32_t> triangles;
};

/// Points that another view does not cover (wrong depths) are outside the visual hull and are dropped. The surface is
/// open at depth discontinuities; features one pixel wide become squares. Pure; thread-safe. Takes about 10 ms.
ObjectShell object_shell(const ViewableObject& object);

}  // namespace rs::compositor
