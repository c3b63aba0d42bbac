#include "engine/core/views/orbit.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/geometry/rig.hpp"

#include <algorithm>
#include <cmath>

namespace rs::engine {
namespace {

Result<Camera> first_captured_camera(const RaySpaceObject& object) {
    if (object.rig_json.empty()) {
        return Error{object.name + ": has no rig with cameras; give cameras with --poses"};
    }
    RS_ASSIGN_OR_RETURN(Rig rig, rig_from_json(object.rig_json, object.name + " (its rig)"));
    if (rig.views.empty() || object.rings.empty() || object.rings.front().views.empty()) {
        return Error{object.name + ": has no views"};
    }
    return rig.views[object.rings.front().views.front()].camera;
}

// Scales the image to the new shape about its centre.
void reshape(Camera& camera, const ViewShape& shape) {
    const int width = shape.width > 0 ? shape.width : camera.width;
    const int height = shape.height > 0 ? shape.height : camera.height;
    double scale = std::min(static_cast<double>(width) / camera.width, static_cast<double>(height) / camera.height);
    if (shape.fov_x_rad) scale = width / (2 * std::tan(*shape.fov_x_rad / 2)) / camera.fl_x;
    camera.cx = (camera.cx - camera.width / 2.0) * scale + width / 2.0;
    camera.cy = (camera.cy - camera.height / 2.0) * scale + height / 2.0;
    camera.fl_x *= scale;
    camera.fl_y *= scale;
    camera.width = width;
    camera.height = height;
}

}  // namespace

Result<std::vector<Camera>> orbit_cameras(const RaySpaceObject& object, int count, const ViewShape& shape) {
    RS_ASSIGN_OR_RETURN(Camera first, first_captured_camera(object));
    reshape(first, shape);
    std::vector<Camera> cameras;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * kPi * i / count;
        const glm::dmat4 turn(std::cos(angle), 0, -std::sin(angle), 0, 0, 1, 0, 0, std::sin(angle), 0, std::cos(angle),
                              0, 0, 0, 0, 1);
        cameras.push_back(first);
        cameras.back().world_from_camera = turn * first.world_from_camera;
    }
    return cameras;
}

Result<Camera> camera_from_eye(const RaySpaceObject& object, const glm::dvec3& eye, const glm::dvec3& at,
                               const ViewShape& shape) {
    RS_ASSIGN_OR_RETURN(Camera captured, first_captured_camera(object));
    if (glm::distance(eye, at) < 1e-6) return Error{"--eye and --at are the same point; move one of them"};
    reshape(captured, shape);
    const double fov_x = 2 * std::atan(captured.width / (2 * captured.fl_x));
    return look_at_camera(eye * object.units_per_radius, at * object.units_per_radius, fov_x, captured.width,
                          captured.height);
}

}  // namespace rs::engine
