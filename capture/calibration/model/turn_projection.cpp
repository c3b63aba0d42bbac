#include "capture/calibration/model/turn_projection.hpp"

namespace rs::capture {

TurnProjection::TurnProjection(const TurntableModel& model) : lens_(model.lens) {
    const glm::dmat3 camera_from_table = camera_rotation(model.pose);
    offset_ = camera_from_table * glm::dvec3(0, 0, -1);
    camera_from_object_.reserve(model.angles_rad.size());
    for (const double angle : model.angles_rad) {
        const glm::dmat3 table_from_object(turned({1, 0, 0}, angle), {0, 1, 0}, turned({0, 0, 1}, angle));
        camera_from_object_.push_back(camera_from_table * table_from_object);
    }
}

std::optional<glm::dvec2> TurnProjection::project(const glm::dvec3& p_in_object, std::size_t view) const {
    const glm::dvec3 p = camera_from_object_[view] * p_in_object + offset_;
    if (p.z > kNearest) return std::nullopt;
    const double x = p.x / -p.z, y = -p.y / -p.z;
    const double r2 = x * x + y * y;
    const double scale = lens_.f_px * (1 + r2 * (lens_.k1 + r2 * lens_.k2));
    return glm::dvec2(lens_.cx + scale * x, lens_.cy + scale * y);
}

std::optional<TurnProjection::ProjectionJacobian> TurnProjection::project_with_jacobian(const glm::dvec3& p_in_object,
                                                                                        std::size_t view) const {
    const glm::dmat3& rotation = camera_from_object_[view];
    const glm::dvec3 p = rotation * p_in_object + offset_;
    if (p.z > kNearest) return std::nullopt;
    const double per_z = -1 / p.z;
    const double x = p.x * per_z, y = -p.y * per_z;
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (lens_.k1 + r2 * lens_.k2);
    const double by_r2 = lens_.k1 + 2 * r2 * lens_.k2;
    const double xx = lens_.f_px * (radial + 2 * by_r2 * x * x);
    const double xy = lens_.f_px * 2 * by_r2 * x * y;
    const double yy = lens_.f_px * (radial + 2 * by_r2 * y * y);
    ProjectionJacobian moving;
    moving.px = {lens_.cx + lens_.f_px * radial * x, lens_.cy + lens_.f_px * radial * y};
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3& change = rotation[k];
        const double of_x = (change.x + x * change.z) * per_z;
        const double of_y = (-change.y + y * change.z) * per_z;
        moving.slope_x[k] = xx * of_x + xy * of_y;
        moving.slope_y[k] = xy * of_x + yy * of_y;
    }
    return moving;
}

glm::dvec3 TurnProjection::centre(std::size_t view) const {
    return -(offset_ * camera_from_object_[view]);
}

std::optional<glm::dvec3> TurnProjection::ray(const glm::dvec2& px, std::size_t view) const {
    const auto direction = undistorted(lens_, px);
    if (!direction) return std::nullopt;
    return glm::normalize(glm::dvec3(direction->x, -direction->y, -1) * camera_from_object_[view]);
}

}  // namespace rs::capture
