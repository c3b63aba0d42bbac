#pragma once
// An object and its place, as the command line gives them: FILE.rso[@X,Y,Z[,TURN_DEGREES[,SCALE]]].

#include "compositor/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <string>

namespace rs::compositor {

// The object stands at X,Y,Z, or at `otherwise` where the text has no place, turned about Y and scaled. A text that
// names a file as it is has no place, whatever signs it holds.
Result<RaySpaceNode> parse_object_argument(const std::string& text, const glm::dvec3& otherwise);

}  // namespace rs::compositor
