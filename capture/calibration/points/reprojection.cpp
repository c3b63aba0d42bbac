#include "capture/calibration/points/reprojection.hpp"

#include <cmath>

namespace rs::capture {

Reprojections::Reprojections(const TurntableModel& model)
    : lens_(model.lens),
      turn_(model),
      table_axis_(camera_rotation(model.pose)[1]),
      tilt_axis_(std::cos(model.pose.roll_rad), std::sin(model.pose.roll_rad), 0) {}

std::optional<Reprojection> Reprojections::of(const glm::dvec3& p_in_object, const Observation& seen) const {
    const glm::dmat3& rotation = turn_.camera_from_object(static_cast<std::size_t>(seen.view));
    const glm::dvec3 from_axis = rotation * p_in_object;
    const glm::dvec3 p = from_axis + turn_.offset();
    if (p.z > TurnProjection::kNearest) return std::nullopt;
    const double per_z = -1 / p.z;
    const double x = p.x * per_z, y = -p.y * per_z;
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (lens_.k1 + r2 * lens_.k2);
    const double f = lens_.f_px;

    Reprojection result;
    const glm::dmat2& weight = seen.weight;
    result.residual = weight * (glm::dvec2(lens_.cx + f * radial * x, lens_.cy + f * radial * y) - seen.p);
    const glm::dvec2 outwards = weight * glm::dvec2(x, y);
    result.by_camera[CameraParameter::kF] = radial * outwards;
    result.by_camera[CameraParameter::kCx] = weight[0];
    result.by_camera[CameraParameter::kCy] = weight[1];
    result.by_camera[CameraParameter::kK1] = f * r2 * outwards;
    result.by_camera[CameraParameter::kK2] = f * r2 * r2 * outwards;

    // Derivatives by x and y of the direction, then by the point in the camera.
    const double by_r2 = lens_.k1 + 2 * r2 * lens_.k2;
    const double xy = f * 2 * by_r2 * x * y;
    const glm::dvec2 by_x = per_z * (weight * glm::dvec2(f * (radial + 2 * by_r2 * x * x), xy));
    const glm::dvec2 by_y = per_z * (weight * glm::dvec2(xy, f * (radial + 2 * by_r2 * y * y)));
    const glm::dvec2 by_depth = x * by_x + y * by_y;
    const auto by_change = [&](const glm::dvec3& change) {
        return change.x * by_x - change.y * by_y + change.z * by_depth;
    };
    result.by_camera[CameraParameter::kPan] = by_change(glm::cross(table_axis_, p));
    result.by_camera[CameraParameter::kTilt] = by_change(glm::cross(tilt_axis_, p));
    result.by_camera[CameraParameter::kRoll] = by_change({-p.y, p.x, 0});
    result.by_angle = by_change(glm::cross(table_axis_, from_axis));
    for (int k = 0; k < 3; ++k) result.by_point[static_cast<std::size_t>(k)] = by_change(rotation[k]);
    return result;
}

}  // namespace rs::capture
