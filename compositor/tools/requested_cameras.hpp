#pragma once
// The cameras that the command line requests.

#include "compositor/scene/scene.hpp"
#include "compositor/tools/view_options.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <functional>
#include <vector>

namespace rs::compositor {

// What the command line states about the camera outranks the scene's path, that its viewpoint, and that the framing of
// all that there is. Only for the latter `objects` is called: they have to be read.
using ObjectsToFrame = std::function<Result<std::vector<PlacedObject>>()>;
Result<std::vector<Camera>> requested_cameras(const ViewArguments& arguments, const Scene& scene,
                                              const ObjectsToFrame& objects, PixelSize size);

}  // namespace rs::compositor
