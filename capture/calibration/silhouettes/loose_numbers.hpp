#pragma once
// What is known of a model's numbers beforehand, as combinations of them that are independent of each other: how
// outlines are asked for numbers (silhouette_adjustment.hpp). Numbers of different units are compared by how far they
// move the outlines.

#include "capture/calibration/model/turntable_model.hpp"
#include "capture/calibration/points/model_covariance.hpp"

#include <Eigen/Core>

namespace rs::capture {

class FreeParameters {
public:
    // `model` and `places` are kept by reference. Of the combinations that `covariance` leaves loosest the first
    // `most`; those that move a point of the outlines, half_px beside the axis, by less than 0.01 px are known, and
    // none.
    FreeParameters(const TurntableModel& model, const NumberPlaces& places, const Eigen::MatrixXd& covariance,
                   double half_px, Eigen::Index most);

    [[nodiscard]] Eigen::Index count() const { return columns_.cols(); }

    // z: how far each combination is moved, in its deviations.
    [[nodiscard]] TurntableModel at(const Eigen::VectorXd& z) const { return stepped(model_, places_, step(z)); }
    [[nodiscard]] Eigen::VectorXd step(const Eigen::VectorXd& z) const { return columns_ * z; }

    // `covariance` once outlines have given `information` of the combinations, if their variances were `disbelief`
    // times as great as stated, and outlines err together by `untold` times as much as they show. Of no combination
    // more than `most` times what was so believed.
    [[nodiscard]] Eigen::MatrixXd told(const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& information,
                                       double untold, double disbelief, double most) const;

    // How much of the angles' variance outlines leave that give `information`, 0 .. 1.
    [[nodiscard]] double angles_left(const Eigen::MatrixXd& information) const;

private:
    const TurntableModel& model_;
    const NumberPlaces& places_;
    Eigen::MatrixXd columns_;  // each one deviation of one combination
};

}  // namespace rs::capture
