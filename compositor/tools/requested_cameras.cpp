#include "compositor/tools/requested_cameras.hpp"

#include "compositor/viewer/views/framing.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace rs::compositor {
namespace {

// The viewpoint that the command line names, or the first.
Result<const Viewpoint*> requested_viewpoint(const ViewArguments& arguments, const Scene& scene) {
    if (arguments.viewpoint.empty()) return scene.viewpoints.empty() ? nullptr : &scene.viewpoints.front();
    std::string known;
    for (const Viewpoint& viewpoint : scene.viewpoints) {
        if (viewpoint.description == arguments.viewpoint) return &viewpoint;
        known += (known.empty() ? "" : ", ") + ("'" + viewpoint.description + "'");
    }
    return Error{"--viewpoint " + arguments.viewpoint + ": the scene has no viewpoint of this description; it has " +
                 (known.empty() ? "none" : known)};
}

CameraPose pose_that_shows_all(const Scene& scene, const std::vector<PlacedObject>& objects, double fov_x_rad,
                               double aspect) {
    const BoundingBox bounds = bounds_of(scene);
    if (!objects.empty() || bounds.empty()) return framing_pose(objects, fov_x_rad, aspect);
    return framing_pose(bounds, fov_x_rad, aspect);
}

}  // namespace

Result<std::vector<Camera>> requested_cameras(const ViewArguments& arguments, const Scene& scene,
                                              const ObjectsToFrame& objects, PixelSize size) {
    const Result<const Viewpoint*> viewpoint = requested_viewpoint(arguments, scene);
    if (!viewpoint) return viewpoint.error();
    const bool looks_elsewhere = !arguments.eye.empty() || !arguments.at.empty();
    const bool at_viewpoint = *viewpoint != nullptr && (!scene.camera || !arguments.viewpoint.empty());
    if (at_viewpoint && !looks_elsewhere && arguments.orbit == 0) {
        Viewpoint here = **viewpoint;
        if (arguments.fov_deg > 0) {
            const double half_x = std::tan(radians(arguments.fov_deg) / 2);
            here.field_of_view_rad = 2 * std::atan(half_x * std::min(size.width, size.height) / size.width);
        }
        return std::vector<Camera>{camera_at(here, size.width, size.height)};
    }
    CameraPath path = at_viewpoint ? CameraPath{} : scene.camera.value_or(CameraPath{});
    if (arguments.fov_deg > 0) path.fov_x_rad = radians(arguments.fov_deg);
    if (at_viewpoint) path.keys = {pose_at(**viewpoint, bounds_of(scene))};
    if (path.keys.empty()) {
        const double aspect = static_cast<double>(size.width) / size.height;
        const Result<std::vector<PlacedObject>> framed = objects();
        if (!framed) return framed.error();
        path.keys = {pose_that_shows_all(scene, *framed, path.fov_x_rad, aspect)};
    }
    if (looks_elsewhere) {
        CameraPose pose = path.keys.front();
        for (const auto& [text, option, point] :
             {std::tuple{&arguments.eye, "--eye", &pose.eye}, std::tuple{&arguments.at, "--at", &pose.at}}) {
            if (text->empty()) continue;
            const Result<Triple> given = parse_triple(*text, option);
            if (!given) return given.error();
            *point = {given->x, given->y, given->z};
        }
        path.keys = {pose};
        path.frames = 1;
    }
    const std::vector<CameraPose> poses =
        arguments.orbit > 0 ? poses_around(path.keys.front(), arguments.orbit) : poses_along(path);
    std::vector<Camera> cameras;
    for (const CameraPose& pose : poses) {
        if (glm::distance(pose.eye, pose.at) < 1e-6) {
            return Error{"the eye and the point looked at are the same; move --eye or --at"};
        }
        cameras.push_back(look_at_camera(pose.eye, pose.at, path.fov_x_rad, size.width, size.height));
    }
    return cameras;
}

}  // namespace rs::compositor
