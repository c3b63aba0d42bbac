#pragma once
// Options of rs-view that choose the cameras: one view, or the frames of a camera path or an orbit.

#include "compositor/scene/scene.hpp"
#include "compositor/viewer/residency/placed_object.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/tool/tool_main.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

/// One view.
struct ViewOptions {
    std::optional<std::string> viewpoint;  // description of one of the scene's viewpoints
    std::optional<std::string> eye;        // X,Y,Z
    std::optional<std::string> at;         // X,Y,Z
    std::optional<double> fov_deg;         // horizontal
};

/// Several frames from one view.
struct MotionOptions {
    std::optional<std::string> path;  // JSON scene file with a camera path
    std::optional<int> orbit_frames;
};

/// Adds --viewpoint, --eye, --at and --fov.
void add_view_options(CLI::App& command, ViewOptions& options);
/// Adds --path and --orbit.
void add_motion_options(CLI::App& command, MotionOptions& options);
/// Adds --size; `size` holds the default.
void add_size_option(CLI::App& command, std::string& size);

/// Returns the objects of the scene; called only if the view is framed to show all of them, because they must be read.
using ObjectsToFrame = std::function<Result<std::vector<PlacedObject>>()>;

/// The camera of each frame. --eye and --at take precedence over --viewpoint, then the camera path, then the scene's
/// first viewpoint, then a view that shows everything.
/// \param size size of the frames, px
Result<std::vector<Camera>> requested_cameras(const ViewOptions& view, const MotionOptions& motion, const Scene& scene,
                                              const ObjectsToFrame& objects, PixelSize size);

}  // namespace rs::compositor
