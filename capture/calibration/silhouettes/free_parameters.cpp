#include "capture/calibration/silhouettes/free_parameters.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

namespace rs::capture {
namespace {

constexpr double kLoose_px = 0.01;

// Approximate movement of the silhouette in px per unit of each number.
Eigen::VectorXd px_per_unit(const TurntableModel& model, const ParameterIndices& places, double half_px) {
    const double f = model.lens.f_px;
    const double slope = half_px / f;
    const std::array<double, kCameraParameters> camera{slope, 1, 1,      f * std::pow(slope, 3), f * std::pow(slope, 5),
                                                       f,     f, half_px};
    Eigen::VectorXd px = Eigen::VectorXd::Ones(places.count);
    for (std::size_t k = 0; k < kCameraParameters; ++k) {
        if (places.camera[k] >= 0) px(places.camera[k]) = camera[k];
    }
    for (const int place : places.angles) {
        if (place >= 0) px(place) = half_px;
    }
    if (places.step >= 0) px(places.step) = half_px * static_cast<double>(places.angles.size());
    return px;
}

}  // namespace

FreeParameters::FreeParameters(const TurntableModel& model, const ParameterIndices& places,
                               const Eigen::MatrixXd& covariance, double half_px, Eigen::Index most)
    : model_(model), places_(places) {
    const Eigen::VectorXd px = px_per_unit(model, places, half_px);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(px.asDiagonal() * covariance * px.asDiagonal());
    if (parts.info() != Eigen::Success) return;
    const Eigen::Index n = covariance.rows();
    Eigen::Index count = 0;
    while (count < std::min(n, most) && parts.eigenvalues()(n - 1 - count) > kLoose_px * kLoose_px) ++count;
    columns_.resize(n, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        columns_.col(k) = px.cwiseInverse().asDiagonal() * parts.eigenvectors().col(n - 1 - k) *
                          std::sqrt(parts.eigenvalues()(n - 1 - k));
    }
}

Eigen::MatrixXd FreeParameters::updated_covariance(const Eigen::MatrixXd& covariance,
                                                   const Eigen::MatrixXd& information, double common_errors,
                                                   double prior_scale, double most) const {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(information);
    const Eigen::ArrayXd gain = prior_scale * parts.eigenvalues().array().max(0);
    const Eigen::ArrayXd variance = (1 + common_errors * common_errors * gain) / (1 + gain).square();
    const Eigen::VectorXd change = prior_scale * variance.min(most) - 1;
    return covariance + columns_ * parts.eigenvectors() * change.asDiagonal() * parts.eigenvectors().transpose() *
                            columns_.transpose();
}

double FreeParameters::remaining_angle_variance(const Eigen::MatrixXd& information) const {
    const Eigen::MatrixXd after = (Eigen::MatrixXd::Identity(count(), count()) + information).inverse();
    double before = 0, left = 0;
    for (const int place : places_.angles) {
        if (place < 0) continue;
        before += columns_.row(place).squaredNorm();
        left += columns_.row(place).dot(after * columns_.row(place).transpose());
    }
    return before > 0 ? left / before : 1;
}

}  // namespace rs::capture
