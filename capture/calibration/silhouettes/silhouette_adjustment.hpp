#pragma once
// Adjustment of a turn's numbers to silhouettes, for any kind of comparison: rays with all other silhouettes
// (silhouette_fit.hpp, coherence_fit.hpp) or tangent planes of pairs (silhouette_tangency.hpp).
//
// Numbers z are in units of their prior standard deviations: each has prior mean 0 and deviation 1, independent of the
// others. Silhouettes leave residuals r, px. With S the mean of r^2 / (1 + r^2 / outlier_px^2) (Geman and McClure,
// 1987), n the number of independent points that the silhouettes are worth and s their deviation_px,
//
//     cost = n S / s^2 + |z|^2 / prior_scale,    or n (1 + log(S / s^2)) for the first term where is_least and S > s^2,
//
// is twice the negative log likelihood except for a constant; the second form is that of an unknown deviation.

#include <Eigen/Core>

#include <functional>
#include <utility>
#include <vector>

namespace rs::capture {

/// Errors of neighbouring silhouette points are correlated: a view counts as this many independent points, however many
/// are compared.
inline constexpr double kIndependentPerView = 24;

/// Error model of the silhouettes.
struct SilhouetteErrors {
    double independent = 0;  // number of independent points
    double outlier_px = 0;   // Geman-McClure scale: larger residuals have little weight
    double deviation_px = 0;
    bool is_least = false;  // the deviation is estimated from the residuals, with deviation_px as lower limit
};

/// Residuals in px as a function of the numbers z; their number does not depend on z.
using SilhouetteResiduals = std::function<std::vector<double>(const Eigen::VectorXd& z)>;

struct SilhouetteComparison {
    SilhouetteResiduals residuals;
    /// Step of each number for central differences: larger than the discretization steps of the residuals.
    Eigen::VectorXd widths;
    /// Optional faster approximation of the residuals near z, which assumes that the views that determine them at z
    /// still do.
    std::function<SilhouetteResiduals(const Eigen::VectorXd& z)> beside = nullptr;
};

/// Caches the last residuals and derivatives. Not thread-safe; the comparison may use several threads.
class SilhouetteAdjustment {
public:
    SilhouetteAdjustment(SilhouetteComparison comparison, const SilhouetteErrors& errors)
        : comparison_(std::move(comparison)), errors_(errors) {}

    /// Replaces the error model. `prior_scale`: factor of the prior variances, initially 1.
    void expect(const SilhouetteErrors& errors, double prior_scale);

    const std::vector<double>& residuals(const Eigen::VectorXd& z);
    const Eigen::MatrixXd& slopes(const Eigen::VectorXd& z);  // Jacobian of the residuals, by central differences
    double cost(const Eigen::VectorXd& z);

    /// Minimizes the cost from z by Ceres' Levenberg-Marquardt with at most `most_steps` iterations; stops if an
    /// iteration gains less than `enough`. Returns false and leaves z unchanged if residuals are not finite.
    /// Deterministic.
    bool improve(Eigen::VectorXd& z, int most_steps, double enough);

    /// Information of the silhouettes alone about the numbers: half the Hessian of their part of the cost, [number,
    /// number].
    Eigen::MatrixXd information(const Eigen::VectorXd& z);

private:
    SilhouetteComparison comparison_;
    SilhouetteErrors errors_;
    double disbelief_ = 1;
    Eigen::VectorXd z_of_residuals_, z_of_slopes_;
    std::vector<double> residuals_;
    Eigen::MatrixXd slopes_;
};

}  // namespace rs::capture
