#pragma once
// Converts cameras around an object, calibrated individually by other tools, to the equivalent turntable model: one
// fixed camera and a turning object (turntable_model.hpp).

#include "capture/calibration/model/turntable_model.hpp"
#include "rayspace/base/result.hpp"

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

namespace rs::capture {

/// Cameras with a larger misfit, as root mean square, are rejected as not being of a turntable.
inline constexpr double kMaxOrientationMisfit_deg = 1.0;
inline constexpr double kMaxPlaceMisfit = 0.01;  // of the distance from the axis

struct TurntableFit {
    CameraPose pose;
    std::vector<double> angles_rad;  // [camera], the first is 0; consecutive angles differ by less than half a turn
    double orientation_misfit_deg =
        0;                    // root mean square residual of the orientations to a rotation about a single axis
    double place_misfit = 0;  // the same for the positions, relative to the distance from the axis
};

/// `world_from_camera`: rigid, camera axes of rayspace/base/conventions.hpp, in any world and unit. Axis and angles are
/// fitted by least squares to all orientations, then the axis' position to all centres. The axis direction is the one
/// that points up in the images. Errors, which begin with `where`: fewer than 3 cameras, cameras without rotation
/// relative to each other or located on the axis, misfits above the limits. Thread-safe.
Result<TurntableFit> fit_turn_to_cameras(std::span<const glm::dmat4> world_from_camera, const std::string& where);

/// The rotation nearest to a matrix in the Frobenius norm, e.g. to a sum of rotations.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix);

}  // namespace rs::capture
