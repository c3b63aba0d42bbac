#include "compositor/viewer/views/framing.hpp"

#include <algorithm>
#include <cmath>

namespace rs::compositor {
namespace {

// Bounding sphere of the object's estimated extent in the scene.
struct Sphere {
    glm::dvec3 middle;
    double radius;
};

Sphere bounding_sphere(const PlacedObject& placed) {
    const UprightExtent& extent = placed.object->extent;
    return {placed.world_from_object.point({0, (extent.bottom + extent.top) / 2, 0}),
            placed.world_from_object.scale * std::hypot(1.0, (extent.top - extent.bottom) / 2)};
}

double captured_elevation_rad(const PlacedObject& placed) {
    const RaySpaceObject& object = placed.object->renderer.object();
    return object.rings.empty() ? 0 : radians(object.rings.front().elevation_udeg * 1e-6);
}

}  // namespace

CameraPose framing_pose(const std::vector<PlacedObject>& objects, double fov_x_rad, double aspect) {
    if (objects.empty()) return {{0, 1.5, 6}, {0, 0.5, 0}};
    glm::dvec3 middle(0);
    double elevation_rad = 0;
    for (const PlacedObject& placed : objects) {
        middle += bounding_sphere(placed).middle / static_cast<double>(objects.size());
        elevation_rad += captured_elevation_rad(placed) / static_cast<double>(objects.size());
    }
    const glm::dvec3 back(0, std::sin(elevation_rad), std::cos(elevation_rad));
    const double half_x_rad = fov_x_rad / 2;
    const double half_y_rad = std::atan(std::tan(half_x_rad) / aspect);
    double distance = 0;
    for (const PlacedObject& placed : objects) {
        const Sphere sphere = bounding_sphere(placed);
        // A sphere is inside a wedge of half angle h if offset * cos h + radius <= depth * sin h.
        const glm::dvec3 offset = sphere.middle - middle;
        const double towards = glm::dot(offset, back);
        const double aside_x = std::abs(offset.x);
        const double aside_y = std::abs(glm::dot(offset, glm::dvec3(0, back.z, -back.y)));
        distance =
            std::max({distance, towards + (aside_x * std::cos(half_x_rad) + sphere.radius) / std::sin(half_x_rad),
                      towards + (aside_y * std::cos(half_y_rad) + sphere.radius) / std::sin(half_y_rad)});
    }
    return {middle + back * distance, middle};
}

CameraPose framing_pose(const BoundingBox& bounds, double fov_x_rad, double aspect) {
    const glm::dvec3 half = (bounds.highest - bounds.lowest) * 0.5;
    const double half_x_rad = fov_x_rad / 2;
    const double half_y_rad = std::atan(std::tan(half_x_rad) / aspect);
    // The front face of the box must fit.
    const double distance =
        half.z + std::max({half.x / std::tan(half_x_rad), half.y / std::tan(half_y_rad), 1e-3 + half.z * 0.1}) * 1.05;
    return {bounds.middle() + glm::dvec3(0, 0, distance), bounds.middle()};
}

Camera camera_at(const Viewpoint& viewpoint, int width, int height) {
    Camera camera;
    camera.width = width;
    camera.height = height;
    camera.fl_x = std::min(width, height) / 2.0 / std::tan(viewpoint.field_of_view_rad / 2);
    camera.fl_y = camera.fl_x;
    camera.cx = width / 2.0;
    camera.cy = height / 2.0;
    camera.world_from_camera = viewpoint.world_from_camera;
    return camera;
}

Viewpoint viewpoint_of(const Camera& camera) {
    Viewpoint viewpoint;
    viewpoint.world_from_camera = camera.world_from_camera;
    viewpoint.field_of_view_rad = 2 * std::atan(0.5 * std::min(camera.width, camera.height) / camera.fl_y);
    return viewpoint;
}

CameraPose pose_at(const Viewpoint& viewpoint, const BoundingBox& bounds) {
    const glm::dvec3 eye(viewpoint.world_from_camera[3]);
    const glm::dvec3 ahead = -glm::dvec3(viewpoint.world_from_camera[2]);
    const double distance = bounds.empty() ? 1 : glm::dot(bounds.middle() - eye, ahead);
    return {eye, eye + ahead * std::max(distance, 0.1)};
}

}  // namespace rs::compositor
