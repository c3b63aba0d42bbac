#pragma once
// The residual of one observation and how it changes with all numbers that it depends on: what a bundle adjustment
// spends its time in, and so written out.
//
// A camera number that is an angle turns the point about an axis through the camera, an angle of the table turns it
// about the table's: each derivative of a point's place is one cross product.

#include "capture/calibration/model/turn_projection.hpp"
#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/points/tracks.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <optional>

namespace rs::capture {

// The order of the camera's numbers.
struct CameraNumber {
    enum Place : std::size_t { kF, kCx, kCy, kK1, kK2, kPan, kTilt, kRoll, kCount };
};
inline constexpr std::size_t kCameraNumbers = CameraNumber::kCount;

// All of them weighted by the observation's weight; px, and px per unit of what changes.
struct Reprojection {
    glm::dvec2 residual{0.0};
    std::array<glm::dvec2, kCameraNumbers> by_camera{};
    glm::dvec2 by_angle{0.0};  // of the observation's view
    std::array<glm::dvec2, 3> by_point{};
};

// For many points and views of one model: sines and cosines are taken once.
class Reprojections {
public:
    explicit Reprojections(const TurntableModel& model);

    // Nothing where the point (of the object as it stands at angle 0) is not before the camera.
    [[nodiscard]] std::optional<Reprojection> of(const glm::dvec3& p_in_object, const Observation& seen) const;

    [[nodiscard]] const TurnProjection& turn() const { return turn_; }

private:
    Lens lens_;
    TurnProjection turn_;
    glm::dvec3 table_axis_, tilt_axis_;  // in the camera; the camera pans about a parallel of the table's axis
};

}  // namespace rs::capture
