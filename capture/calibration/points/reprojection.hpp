#pragma once
// The residual of one observation, with its derivatives written out: they are what a bundle adjustment spends its time
// in, and automatic ones took a fifth of a calibration.

#include "capture/calibration/points/tracks.hpp"

#include <ceres/sized_cost_function.h>

namespace rs::capture {

// Parameter blocks lens (5), pose (3), angle (1), point (3) as in projection.hpp; residuals are weighted. Fails where
// the point is not before the camera.
class Reprojection final : public ceres::SizedCostFunction<2, 5, 3, 1, 3> {
public:
    // The view's angle is `turns` times its parameter: the view's number where all share one step.
    Reprojection(const Observation& seen, double turns) : seen_(seen), turns_(turns) {}

    bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override;

private:
    Observation seen_;
    double turns_;
};

}  // namespace rs::capture
