#pragma once
// Object argument of the command line: FILE.rso[@X,Y,Z[,TURN_DEGREES[,SCALE]]].

#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <string>

namespace rs::compositor {

/// Places the object at X,Y,Z, or at `otherwise` without a position, rotated about Y and scaled. A text that names an
/// existing file is a path without a position, whatever characters it contains.
Result<RaySpaceNode> parse_object_argument(const std::string& text, const glm::dvec3& otherwise);

}  // namespace rs::compositor
