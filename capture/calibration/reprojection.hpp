#pragma once
// The residual of one observation, with its derivatives written out: they are what a bundle adjustment spends its time
// in, and automatic ones took a fifth of a calibration.

#include <ceres/sized_cost_function.h>

namespace rs::capture {

// Parameter blocks lens (5), pose (3), angle (1), point (3) as in projection.hpp; residuals in px. Fails where the
// point is not before the camera.
class Reprojection final : public ceres::SizedCostFunction<2, 5, 3, 1, 3> {
public:
    struct Observation {
        double x = 0;  // seen, px
        double y = 0;
        double turns = 1;  // the angle is this many times its parameter: the view's number where all share one step
        // The residual is multiplied by this symmetric matrix.
        double weight_xx = 1, weight_xy = 0, weight_yy = 1;
    };

    explicit Reprojection(const Observation& seen) : seen_(seen) {}

    bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override;

private:
    Observation seen_;
};

}  // namespace rs::capture
