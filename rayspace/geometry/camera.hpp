#pragma once
// A pinhole camera: pose and intrinsics. Conventions: conventions.hpp.

#include <glm/glm.hpp>

namespace rs {

struct Camera {
    int width = 0;    // px
    int height = 0;   // px
    double fl_x = 0;  // focal length, px
    double fl_y = 0;
    double cx = 0;  // principal point, px from the top left corner
    double cy = 0;
    glm::dmat4 world_from_camera{1.0};  // rigid; columns are right, up, back, centre

    [[nodiscard]] glm::dvec3 right() const { return glm::dvec3(world_from_camera[0]); }
    [[nodiscard]] glm::dvec3 up() const { return glm::dvec3(world_from_camera[1]); }
    [[nodiscard]] glm::dvec3 forward() const { return -glm::dvec3(world_from_camera[2]); }
    [[nodiscard]] glm::dvec3 centre() const { return glm::dvec3(world_from_camera[3]); }

    /// Direction through pixel position (x, y), scaled to a component of 1 along forward(): centre() + depth * ray(x,
    /// y) is the point at axial depth `depth`.
    [[nodiscard]] glm::dvec3 ray(double x, double y) const {
        return forward() + right() * ((x - cx) / fl_x) + up() * ((cy - y) / fl_y);
    }

    /// Pixel position (x, y) and axial depth (z) of a point; x and y are valid only if z > 0.
    [[nodiscard]] glm::dvec3 project(const glm::dvec3& p_in_world) const {
        const glm::dvec3 v = p_in_world - centre();
        const double depth = glm::dot(v, forward());
        return {cx + fl_x * glm::dot(v, right()) / depth, cy - fl_y * glm::dot(v, up()) / depth, depth};
    }
};

/// A camera at `eye` directed at `target`, world Y up (Z if the view is vertical), horizontal field of view
/// `fov_x_rad`, square pixels, principal point in the middle. eye != target.
Camera look_at_camera(const glm::dvec3& eye, const glm::dvec3& target, double fov_x_rad, int width, int height);

/// True if every image column is a vertical plane of rays: no pitch and no roll, within 1e-9.
bool is_upright(const Camera& camera);

/// The rotation's deviation from orthonormality: max |R^T R - I|, plus 1 if the determinant is negative.
double rotation_error(const Camera& camera);

}  // namespace rs
