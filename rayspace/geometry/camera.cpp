#include "rayspace/geometry/camera.hpp"

#include "rayspace/api/types/check.hpp"

#include <algorithm>
#include <cmath>

namespace rs {

Camera look_at_camera(const glm::dvec3& eye, const glm::dvec3& target, double fov_x_rad, int width, int height) {
    const glm::dvec3 line_of_sight = target - eye;
    RS_CHECK(glm::length(line_of_sight) > 0);
    RS_CHECK(fov_x_rad > 0 && width > 0 && height > 0);
    const glm::dvec3 forward = glm::normalize(line_of_sight);
    // In a vertical view Y does not determine the image's orientation.
    const bool vertical = std::hypot(forward.x, forward.z) < 1e-12;
    const glm::dvec3 world_up = vertical ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, world_up));
    const glm::dvec3 up = glm::cross(right, forward);

    Camera camera;
    camera.width = width;
    camera.height = height;
    camera.fl_x = width / (2 * std::tan(fov_x_rad / 2));
    camera.fl_y = camera.fl_x;
    camera.cx = width / 2.0;
    camera.cy = height / 2.0;
    camera.world_from_camera =
        glm::dmat4(glm::dvec4(right, 0), glm::dvec4(up, 0), glm::dvec4(-forward, 0), glm::dvec4(eye, 1));
    return camera;
}

bool is_upright(const Camera& camera) {
    constexpr double kTolerance = 1e-9;
    return glm::length(camera.up() - glm::dvec3(0, 1, 0)) <= kTolerance;
}

double rotation_error(const Camera& camera) {
    const glm::dmat3 rotation(camera.world_from_camera);
    const glm::dmat3 product = glm::transpose(rotation) * rotation;
    double worst = 0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            const double defect = std::abs(product[column][row] - (column == row ? 1.0 : 0.0));
            // NaN compares false with everything and would count as no deviation.
            worst = std::isnan(defect) ? INFINITY : std::max(worst, defect);
        }
    }
    return glm::determinant(rotation) < 0 ? worst + 1 : worst;
}

}  // namespace rs
