#pragma once
// rs-view in windows.

#include "compositor/scene/scene.hpp"
#include "compositor/tools/view_options.hpp"
#include "compositor/tools/wall_views.hpp"
#include "compositor/viewer/showroom.hpp"
#include "compositor/window/window.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <memory>
#include <string>

namespace rs::compositor {

Result<Window> open_window(const ViewArguments& arguments, PixelSize size);

// In a window: beginning where the first camera is, then at the scene's viewpoints.
Status run_visit(Window window, const ViewArguments& arguments, const Scene& scene, std::unique_ptr<Showroom> showroom,
                 const std::string& executor, const Camera& first);

// A window for each wall.
Status run_walls(const ViewArguments& arguments, const Scene& scene, const WallViews& views,
                 std::unique_ptr<Showroom> showroom);

}  // namespace rs::compositor
