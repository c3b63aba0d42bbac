#pragma once
// The surface of an object made of images, as far as its shadow needs it: what the engine shows of it, with depth,
// from places all around at the elevations that its capture holds, put together. Any light may shine on that, also from
// straight above, where no image was taken and the engine has no answer.

#include "compositor/viewer/residency/placed_object.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace rs::compositor {

struct ObjectShell {
    std::vector<glm::vec3> corners;  // object radii
    std::vector<std::uint32_t> triangles;
};

// Points that some view does not show (a wrong depth) lie outside of the visual hull and are left out; where depth
// jumps the surface is open, and what is one pixel thin is a square. Pure; thread-safe. Some ten milliseconds.
ObjectShell object_shell(const ViewableObject& object);

}  // namespace rs::compositor
