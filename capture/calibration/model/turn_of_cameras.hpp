#pragma once
// From cameras around an object, as others calibrated them one by one, to the turntable that shows the same: one camera
// that stands still before a turning object (turntable_model.hpp).

#include "capture/calibration/model/turntable_model.hpp"
#include "rayspace/base/result.hpp"

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

namespace rs::capture {

// Further from a turntable than this, as root mean square over the cameras, and it is not taken for one.
inline constexpr double kMaxOrientationMisfit_deg = 1.0;
inline constexpr double kMaxPlaceMisfit = 0.01;  // of the distance from the axis

struct TurnOfCameras {
    CameraPose pose;
    std::vector<double> angles_rad;  // [camera], the first is 0, going on from one to the next by less than half a turn
    double orientation_misfit_deg = 0;  // root mean squares of what the single axis does not explain
    double place_misfit = 0;            // of the distance from the axis
};

// `world_from_camera`: rigid, camera axes of rayspace/base/conventions.hpp, in any world and unit. Axis and angles are
// fitted by least squares to all orientations, then the axis' place to all centres. Of the axis' two directions the one
// that points up in the images counts as up. Errors, which begin with `where`: fewer than 3 cameras, cameras that do
// not turn against each other or stand on the axis, misfits above the limits. Thread-safe.
Result<TurnOfCameras> turn_of_cameras(std::span<const glm::dmat4> world_from_camera, const std::string& where);

// The rotation nearest to a matrix, for instance to a sum of rotations.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix);

}  // namespace rs::capture
