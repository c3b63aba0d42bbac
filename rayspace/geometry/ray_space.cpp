#include "rayspace/geometry/ray_space.hpp"

#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"

#include <cmath>

namespace rs {

ReferencePlane reference_plane(int k, int count) {
    RS_CHECK(count > 0 && k >= 0 && k < count);
    const double t = 2 * kPi * k / count;
    return {{std::sin(t), 0, std::cos(t)}, {std::cos(t), 0, -std::sin(t)}};
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
    // Directions in OpenGL camera axes: the ray of pixel (x, y, 1) is ((x - cx) / fl_x, (cy - y) / fl_y, -1).
    const auto direction_from_pixel = [](const Camera& c) {
        return glm::dmat3(1 / c.fl_x, 0, 0, 0, -1 / c.fl_y, 0, -c.cx / c.fl_x, c.cy / c.fl_y, -1);
    };
    const glm::dmat3 to_from_from =
        glm::transpose(glm::dmat3(to.world_from_camera)) * glm::dmat3(from.world_from_camera);
    return glm::inverse(direction_from_pixel(to)) * to_from_from * direction_from_pixel(from);
}

}  // namespace rs
