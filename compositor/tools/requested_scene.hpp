#pragma once
// The scene that the command line requests, and who draws its objects.

#include "compositor/scene/scene.hpp"
#include "compositor/tools/view_options.hpp"
#include "engine/core/definition/executor.hpp"
#include "rayspace/base/result.hpp"

#include <memory>
#include <string>
#include <vector>

namespace rs::compositor {

// The file's scene, or a floor, with the lights, the path and the objects that the command line adds.
Result<Scene> requested_scene(const ViewArguments& arguments);

// Who draws with the core; null where that is alone.
Result<std::unique_ptr<engine::Executor>> requested_executor(const ViewArguments& arguments);

ObjectDepth requested_depth(const ViewArguments& arguments);

// A line each, for people.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace rs::compositor
