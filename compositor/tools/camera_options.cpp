#include "compositor/tools/camera_options.hpp"

#include "compositor/scene/reader/scene_file.hpp"
#include "compositor/viewer/views/framing.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace rs::compositor {
namespace {

// The named viewpoint, or the scene's first one; null if the scene has none.
Result<const Viewpoint*> requested_viewpoint(const ViewOptions& view, const Scene& scene) {
    if (!view.viewpoint) return scene.viewpoints.empty() ? nullptr : &scene.viewpoints.front();
    std::string names;
    for (const Viewpoint& viewpoint : scene.viewpoints) {
        if (viewpoint.description == *view.viewpoint) return &viewpoint;
        names += (names.empty() ? "" : ", ") + ("'" + viewpoint.description + "'");
    }
    return Error{"--viewpoint " + *view.viewpoint + ": the scene has no viewpoint of this description; it has " +
                 (names.empty() ? "none" : names)};
}

CameraPose pose_that_shows_all(const Scene& scene, const std::vector<PlacedObject>& objects, double fov_x_rad,
                               double aspect) {
    const BoundingBox bounds = bounds_of(scene);
    if (!objects.empty() || bounds.empty()) return framing_pose(objects, fov_x_rad, aspect);
    return framing_pose(bounds, fov_x_rad, aspect);
}

// The camera path of --path, else the scene's, if it has one.
Result<std::optional<CameraPath>> requested_path(const MotionOptions& motion, const Scene& scene) {
    if (!motion.path) return scene.camera;
    RS_ASSIGN_OR_RETURN(const Scene walk, read_scene(*motion.path));
    if (!walk.camera) return Error{*motion.path + ": has no camera path (compositor/README.md, JSON, \"camera\")"};
    return walk.camera;
}

}  // namespace

void add_view_options(CLI::App& command, ViewOptions& options) {
    command
        .add_option("--viewpoint", options.viewpoint, "description of one of the scene's viewpoints (default: first)")
        ->type_name("NAME");
    command.add_option("--eye", options.eye, "camera position in scene units (default: viewpoint, or all is in view)")
        ->type_name("X,Y,Z");
    command.add_option("--at", options.at, "point that the camera looks at")->type_name("X,Y,Z");
    command.add_option("--fov", options.fov_deg, "horizontal field of view, 1..150 degrees (default: scene, or 50)")
        ->check(CLI::Range(1.0, 150.0).description(""))
        ->type_name("DEG");
}

void add_motion_options(CLI::App& command, MotionOptions& options) {
    command.add_option("--path", options.path, "JSON scene file with a camera path, in place of the scene's")
        ->type_name("FILE.json");
    command.add_option("--orbit", options.orbit_frames, "N frames once around the point that the camera looks at")
        ->check(CLI::Range(1, 100000).description(""))
        ->type_name("N");
}

void add_size_option(CLI::App& command, std::string& size) {
    command.add_option("--size", size, "size of a frame in pixels")->type_name("WxH")->capture_default_str();
}

Result<std::vector<Camera>> requested_cameras(const ViewOptions& view, const MotionOptions& motion, const Scene& scene,
                                              const ObjectsToFrame& objects, PixelSize size) {
    RS_ASSIGN_OR_RETURN(const std::optional<CameraPath> given_path, requested_path(motion, scene));
    RS_ASSIGN_OR_RETURN(const Viewpoint* viewpoint, requested_viewpoint(view, scene));
    const bool pose_given = view.eye || view.at;
    const bool at_viewpoint = viewpoint != nullptr && (!given_path || view.viewpoint);
    if (at_viewpoint && !pose_given && !motion.orbit_frames) {
        Viewpoint here = *viewpoint;
        if (view.fov_deg) {
            const double half_x = std::tan(radians(*view.fov_deg) / 2);
            here.field_of_view_rad = 2 * std::atan(half_x * std::min(size.width, size.height) / size.width);
        }
        return std::vector<Camera>{camera_at(here, size.width, size.height)};
    }
    CameraPath path = at_viewpoint ? CameraPath{} : given_path.value_or(CameraPath{});
    if (view.fov_deg) path.fov_x_rad = radians(*view.fov_deg);
    if (at_viewpoint) path.keys = {pose_at(*viewpoint, bounds_of(scene))};
    if (path.keys.empty()) {
        const double aspect = static_cast<double>(size.width) / size.height;
        RS_ASSIGN_OR_RETURN(const std::vector<PlacedObject> framed, objects());
        path.keys = {pose_that_shows_all(scene, framed, path.fov_x_rad, aspect)};
    }
    if (pose_given) {
        CameraPose pose = path.keys.front();
        for (const auto& [text, option, point] :
             {std::tuple{&view.eye, "--eye", &pose.eye}, std::tuple{&view.at, "--at", &pose.at}}) {
            if (!*text) continue;
            RS_ASSIGN_OR_RETURN(const Triple given, parse_triple(**text, option));
            *point = {given.x, given.y, given.z};
        }
        path.keys = {pose};
        path.frames = 1;
    }
    const std::vector<CameraPose> poses =
        motion.orbit_frames ? poses_around(path.keys.front(), *motion.orbit_frames) : poses_along(path);
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
