#include "compositor/viewer/object_view.hpp"

#include <algorithm>
#include <cmath>

namespace rs::compositor {
namespace {

// The foot's depth is taken this much above it (object radii), to be on the right side of the
// ground that it stands on.
constexpr double kAboveGround = 0.01;

// The reciprocal depth, as a linear form of (x, y, 1), of the plane { p : dot(p - eye, normal) = distance }.
glm::dvec3 inverse_depth_of_plane(const Camera& camera, const glm::dvec3& normal, double distance) {
    // eye + depth * ray(x, y) lies on the plane where depth * dot(normal, ray) = distance.
    return glm::dvec3(glm::dot(normal, camera.right()) / camera.fl_x, -glm::dot(normal, camera.up()) / camera.fl_y,
                      glm::dot(normal, camera.ray(0, 0))) /
           distance;
}

}  // namespace

std::optional<ObjectView> view_of_object(const PlacedObject& placed, const Camera& camera_in_world) {
    const Camera camera = camera_in_node(camera_in_world, placed.world_from_object);
    const glm::dvec3 eye = camera.centre();
    if (camera.fl_x < 0.5 * glm::length(eye)) return std::nullopt;
    const double distance = std::hypot(eye.x, eye.z);
    if (distance < 1e-6) return std::nullopt;
    const auto rectangle = covering_rectangle(placed.object->bounds, camera);
    if (!rectangle) return std::nullopt;

    const double scale = placed.world_from_object.scale;
    ObjectView view;
    view.rectangle = *rectangle;
    view.camera = camera;
    view.camera.width = rectangle->width;
    view.camera.height = rectangle->height;
    view.camera.cx -= rectangle->x;
    view.camera.cy -= rectangle->y;
    view.camera.world_from_camera[3] = glm::dvec4(eye * placed.object->renderer.object().units_per_radius, 1);
    view.plane_distance = distance * scale;
    const glm::dvec3 inward(-eye.x / distance, 0, -eye.z / distance);
    view.inverse_depth_facing = inverse_depth_of_plane(camera, inward, distance * scale);
    const double above_foot = eye.y - (placed.object->extent.bottom + kAboveGround);
    view.from_above = above_foot >= 0;
    const double foot_distance = std::copysign(std::max(std::abs(above_foot), 1e-6), above_foot);
    view.inverse_depth_foot = inverse_depth_of_plane(camera, {0, -1, 0}, foot_distance * scale);
    return view;
}

}  // namespace rs::compositor
