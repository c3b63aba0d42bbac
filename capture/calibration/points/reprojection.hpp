#pragma once
// Residual of one observation and its analytic derivatives, the inner loop of bundle adjustment.
//
// A camera number that is an angle rotates the point about an axis through the camera, an angle of the table rotates it
// about the table's axis: each derivative of a point's position is one cross product.

#include "capture/calibration/model/turn_projection.hpp"
#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/points/tracks.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <optional>

namespace rs::capture {

/// The order of the camera's numbers.
struct CameraParameter {
    enum Place : std::size_t { kF, kCx, kCy, kK1, kK2, kPan, kTilt, kRoll, kCount };
};
inline constexpr std::size_t kCameraParameters = CameraParameter::kCount;

/// Residual and derivatives, multiplied by the observation's weight; px, and px per unit of the number.
struct Reprojection {
    glm::dvec2 residual{0.0};
    std::array<glm::dvec2, kCameraParameters> by_camera{};
    glm::dvec2 by_angle{0.0};  // by the angle of the observation's view
    std::array<glm::dvec2, 3> by_point{};
};

/// Evaluates many points and views of one model with precomputed rotations.
class Reprojections {
public:
    explicit Reprojections(const TurntableModel& model);

    /// Nothing if the point (of the object at angle 0) is not in front of the camera.
    [[nodiscard]] std::optional<Reprojection> of(const glm::dvec3& p_in_object, const Observation& seen) const;

    [[nodiscard]] const TurnProjection& turn() const { return turn_; }

private:
    Lens lens_;
    TurnProjection turn_;
    glm::dvec3 table_axis_, tilt_axis_;  // in camera axes; the pan axis is parallel to the table's axis
};

}  // namespace rs::capture
