#include "rayspace/geometry/ray_space.hpp"

#include "rayspace/base/check.hpp"
#include "rayspace/base/conventions.hpp"

#include <cmath>

namespace rs {

ReferencePlane reference_plane(int k, int count) {
    RS_CHECK(count > 0 && k >= 0 && k < count);
    const double t = 2 * kPi * k / count;
    return {{std::sin(t), 0, std::cos(t)}, {std::cos(t), 0, -std::sin(t)}};
}

int most_square_plane(const glm::dvec3& direction, int count) {
    int best = 0;
    double best_squareness = -glm::dot(direction, reference_plane(0, count).normal);
    for (int k = 1; k < count; ++k) {
        const double squareness = -glm::dot(direction, reference_plane(k, count).normal);
        if (squareness > best_squareness) {
            best = k;
            best_squareness = squareness;
        }
    }
    return best;
}

std::optional<PlaneRay> to_ray_space(const Ray& ray, const ReferencePlane& plane) {
    const double against = -glm::dot(ray.direction, plane.normal);
    if (against <= 0) return std::nullopt;
    const ViewpointLine line = viewpoint_line(ray.origin, plane);
    PlaneRay result;
    result.u = glm::dot(ray.direction, plane.tangent) / against;
    result.slope = ray.direction.y / against;
    result.x = line.x_at(result.u);
    result.y = line.b + result.slope * line.c;
    return result;
}

Ray from_ray_space(const PlaneRay& ray, const ReferencePlane& plane, double c) {
    const glm::dvec3 up(0, 1, 0);
    return {(ray.x - ray.u * c) * plane.tangent + (ray.y - ray.slope * c) * up + c * plane.normal,
            ray.u * plane.tangent + ray.slope * up - plane.normal};
}

ViewpointLine viewpoint_line(const glm::dvec3& viewpoint, const ReferencePlane& plane) {
    return {glm::dot(viewpoint, plane.tangent), viewpoint.y, glm::dot(viewpoint, plane.normal)};
}

Camera upright_camera(const Camera& camera) {
    glm::dvec3 heading(camera.forward().x, 0, camera.forward().z);
    if (glm::length(heading) < 1e-9) {
        const double sign = camera.forward().y < 0 ? 1 : -1;
        heading = sign * glm::dvec3(camera.up().x, 0, camera.up().z);
    }
    heading = glm::normalize(heading);
    const glm::dvec3 up(0, 1, 0);
    Camera result = camera;
    result.world_from_camera = glm::dmat4(glm::dvec4(glm::cross(heading, up), 0), glm::dvec4(up, 0),
                                          glm::dvec4(-heading, 0), camera.world_from_camera[3]);
    return result;
}

glm::dmat3 pixel_in_to_from_pixel_in_from(const Camera& to, const Camera& from) {
    // Directions in OpenGL camera axes; a pixel (x, y, 1) of a camera looks along ((x - cx) / fl_x, (cy - y) / fl_y,
    // -1).
    const auto direction_from_pixel = [](const Camera& c) {
        return glm::dmat3(1 / c.fl_x, 0, 0, 0, -1 / c.fl_y, 0, -c.cx / c.fl_x, c.cy / c.fl_y, -1);
    };
    const glm::dmat3 to_from_from =
        glm::transpose(glm::dmat3(to.world_from_camera)) * glm::dmat3(from.world_from_camera);
    return glm::inverse(direction_from_pixel(to)) * to_from_from * direction_from_pixel(from);
}

}  // namespace rs
