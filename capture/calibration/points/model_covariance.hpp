#pragma once
// From the covariance of a turn's unknown numbers, however it was found, to the deviations that are told.

#include "capture/calibration/model/calibration.hpp"
#include "capture/calibration/points/bundle.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace rs::capture {

// The order of the camera's numbers.
struct CameraNumber {
    enum Place : std::size_t { kF, kCx, kCy, kK1, kK2, kPan, kTilt, kRoll, kCount };
};
inline constexpr std::size_t kCameraNumbers = CameraNumber::kCount;

// Where the numbers of a model stand among the unknowns, camera first, then angles or the step; -1: held.
struct NumberPlaces {
    std::array<int, kCameraNumbers> camera{};
    std::vector<int> angles;  // [view]; the first view's is held always, and where a common step is sought all are
    int step = -1;
    int count = 0;

    // is_seen[view]: a view that nothing is seen in keeps its angle.
    NumberPlaces(const BundleFreedom& free, const std::vector<bool>& is_seen);
};

// `model` with the numbers at `places` changed by `step`.
TurntableModel stepped(TurntableModel model, const NumberPlaces& places, const Eigen::VectorXd& step);

// What was held has a deviation of 0; all are infinite where `covariance` is empty, for nothing is known. Unknowns of
// `covariance` beyond places.count do not count. `at_px` is the row (for an axis nearer to sideways the column) at
// which the axis' position is judged.
ModelDeviations deviations_of(const TurntableModel& model, const NumberPlaces& places,
                              const Eigen::MatrixXd& covariance, double at_px);

}  // namespace rs::capture
