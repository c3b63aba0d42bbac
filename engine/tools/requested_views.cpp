#include "engine/tools/requested_views.hpp"

#include "engine/core/views/orbit.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/rig_conventions.hpp"
#include "rayspace/tool/tool_main.hpp"

namespace rs::engine {
namespace {

Result<ViewShape> view_shape(const RequestedViews& views) {
    ViewShape shape;
    if (!views.size.empty()) {
        RS_ASSIGN_OR_RETURN(const PixelSize size, parse_size(views.size));
        shape.width = size.width;
        shape.height = size.height;
    }
    if (views.fov_deg != 0) shape.fov_x_rad = radians(views.fov_deg);
    return shape;
}

Result<std::vector<Camera>> cameras_of_rig(const std::string& path, const ViewShape& shape) {
    RS_ASSIGN_OR_RETURN(Rig rig, read_rig(path));
    apply_rig_conventions(rig);
    if (rig.views.empty()) return Error{path + ": has no frames to render"};
    std::vector<Camera> cameras;
    for (const RigView& view : rig.views) {
        cameras.push_back(shape.width > 0 ? resized(view.camera, shape.width, shape.height) : view.camera);
    }
    return cameras;
}

}  // namespace

Camera resized(Camera camera, int width, int height) {
    camera.cx *= static_cast<double>(width) / camera.width;
    camera.fl_x *= static_cast<double>(width) / camera.width;
    camera.cy *= static_cast<double>(height) / camera.height;
    camera.fl_y *= static_cast<double>(height) / camera.height;
    camera.width = width;
    camera.height = height;
    return camera;
}

Result<std::vector<Camera>> requested_cameras(const RaySpaceObject& object, const RequestedViews& views) {
    RS_ASSIGN_OR_RETURN(const ViewShape shape, view_shape(views));
    if (!views.poses.empty()) return cameras_of_rig(views.poses, shape);
    if (views.orbit > 0) return orbit_cameras(object, views.orbit, shape);
    RS_ASSIGN_OR_RETURN(const Triple eye, parse_triple(views.eye, "--eye"));
    RS_ASSIGN_OR_RETURN(const Triple at, parse_triple(views.at, "--at"));
    RS_ASSIGN_OR_RETURN(const Camera camera, camera_from_eye(object, {eye.x, eye.y, eye.z}, {at.x, at.y, at.z}, shape));
    return std::vector<Camera>{camera};
}

void add_view_options(CLI::App& command, RequestedViews& views, bool required) {
    CLI::Option_group* selection = command.add_option_group("views", "Views to render");
    selection->add_option("--orbit", views.orbit, "N views around the object, as captured")
        ->check(CLI::Range(1, 100000));
    CLI::Option* poses = selection->add_option("--poses", views.poses, "cameras of a transforms.json");
    CLI::Option* eye =
        selection->add_option("--eye", views.eye, "one view from X,Y,Z, in object radii; Y is the turntable axis");
    selection->require_option(required ? 1 : 0, 1);
    command.add_option("--at", views.at, "with --eye: target point X,Y,Z, in object radii")
        ->capture_default_str()
        ->needs(eye);
    command.add_option("--size", views.size, "size of the views, WxH in pixels; default: as captured");
    command.add_option("--fov", views.fov_deg, "horizontal field of view in degrees; default: as captured")
        ->check(CLI::Range(0.01, 159.0))
        ->excludes(poses);
}

}  // namespace rs::engine
