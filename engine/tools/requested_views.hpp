#pragma once
// Options that select the views to render: an orbit, the cameras of a rig, or one view from an eye.

#include "rayspace/base/result.hpp"
#include "rayspace/geometry/camera.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace rs::engine {

struct RequestedViews {
    std::string poses;
    std::string eye;
    std::string at = "0,0,0";
    std::string size;
    int orbit = 0;
    double fov_deg = 0;
};

// Adds --orbit, --poses, --eye (at most one of them; exactly one if `required`), --at, --size and --fov.
void add_view_options(CLI::App& command, RequestedViews& views, bool required = true);

// Scales the image of a camera to another size.
Camera resized(Camera camera, int width, int height);

// Cameras of the requested views, in the units of the object's rig.
Result<std::vector<Camera>> requested_cameras(const RaySpaceObject& object, const RequestedViews& views);

}  // namespace rs::engine
