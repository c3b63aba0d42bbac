#pragma once
// Parameterization of a model's free numbers by the principal components of their prior covariance; silhouettes are
// fitted in these coordinates (silhouette_adjustment.hpp). Numbers of different units are scaled by their effect on the
// silhouettes in px.

#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/points/model_covariance.hpp"

#include <Eigen/Core>

namespace rs::capture {

class FreeParameters {
public:
    /// `model` and `places` are kept by reference. Uses the `most` components with the largest variance in
    /// `covariance`; components that move a silhouette point at half_px from the axis by less than 0.01 px are held
    /// constant.
    FreeParameters(const TurntableModel& model, const ParameterIndices& places, const Eigen::MatrixXd& covariance,
                   double half_px, Eigen::Index most);

    [[nodiscard]] Eigen::Index count() const { return columns_.cols(); }

    /// z: offset along each component, in standard deviations.
    [[nodiscard]] TurntableModel at(const Eigen::VectorXd& z) const { return apply_step(model_, places_, step(z)); }
    [[nodiscard]] Eigen::VectorXd step(const Eigen::VectorXd& z) const { return columns_ * z; }

    /// Posterior of `covariance` after silhouettes gave `information` about the components, if the prior variances are
    /// scaled by `prior_scale` and the silhouettes have common errors `common_errors` times as large as their stated
    /// ones. The variance of each component is limited to `most` times its scaled prior variance.
    [[nodiscard]] Eigen::MatrixXd updated_covariance(const Eigen::MatrixXd& covariance,
                                                     const Eigen::MatrixXd& information, double common_errors,
                                                     double prior_scale, double most) const;

    /// Share of the angles' variance that remains after silhouettes gave `information`, 0 .. 1.
    [[nodiscard]] double remaining_angle_variance(const Eigen::MatrixXd& information) const;

private:
    const TurntableModel& model_;
    const ParameterIndices& places_;
    Eigen::MatrixXd columns_;  // each one standard deviation of one component
};

}  // namespace rs::capture
