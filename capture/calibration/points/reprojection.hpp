#pragma once
// The residual of one observation, with its derivatives written out: they are what a bundle adjustment spends its time
// in, and automatic ones took a fifth of a calibration.

#include "capture/calibration/points/tracks.hpp"

#include <ceres/evaluation_callback.h>
#include <ceres/sized_cost_function.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rs::capture {

// Sines and cosines that all observations of a turn share, taken once before each evaluation.
class PosedTurn final : public ceres::EvaluationCallback {
public:
    // Kept by reference: what is adjusted. View i stands at angles_rad[i], or at i times `step_rad` where one is given.
    PosedTurn(const std::array<double, 3>& pose, const double* step_rad, const std::vector<double>& angles_rad);

    void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;

    struct Direction {
        double cosine = 1, sine = 0;
        explicit Direction(double angle_rad) : cosine(std::cos(angle_rad)), sine(std::sin(angle_rad)) {}
    };
    [[nodiscard]] const std::array<Direction, 3>& pose() const { return pose_; }  // pan, tilt, roll
    [[nodiscard]] const Direction& view(int view) const { return views_[static_cast<std::size_t>(view)]; }

private:
    const std::array<double, 3>& numbers_;
    const double* step_rad_;
    const std::vector<double>& angles_rad_;
    std::array<Direction, 3> pose_;
    std::vector<Direction> views_;
};

// Parameter blocks lens (5), pose (3), angle (1), point (3) as in projection.hpp; residuals are weighted. Fails where
// the point is not before the camera.
class Reprojection final : public ceres::SizedCostFunction<2, 5, 3, 1, 3> {
public:
    // The view's angle is `turns` times its parameter: the view's number where all share one step. `turn`, where given,
    // is of the same parameters and prepared for each evaluation.
    Reprojection(const Observation& seen, double turns, const PosedTurn* turn = nullptr)
        : seen_(seen), turns_(turns), turn_(turn) {}

    bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override;

private:
    Observation seen_;
    double turns_;
    const PosedTurn* turn_;
};

}  // namespace rs::capture
