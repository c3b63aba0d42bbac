#pragma once
// The one adjustment by which numbers of a turn are estimated from outlines, whatever of the outlines is compared: rays
// with all other outlines (silhouette_fit.hpp, coherence_fit.hpp) or tangent planes of pairs (silhouette_tangency.hpp).
//
// Numbers are counted in deviations of what was known of them before: each is expected at 0 with a deviation of 1, and
// independent of the others. Outlines leave residuals r, px. With S the mean of r^2 / (1 + r^2 / outlier_px^2) (Geman
// and McClure, 1987), n the count of independent points that the outlines are worth and s their deviation_px,
//
//     cost = n S / s^2 + |z|^2 / disbelief,    or n (1 + log(S / s^2)) for the first term where is_least and S > s^2,
//
// is twice the negative log likelihood but for a constant; the latter is that of a deviation which nobody knows.

#include <Eigen/Core>

#include <functional>
#include <utility>
#include <vector>

namespace rs::capture {

// Neighbouring points of an outline are off alike: a view is worth this many independent ones, however many are
// compared.
inline constexpr double kIndependentPerView = 24;

// What outlines are off by.
struct SilhouetteErrors {
    double independent = 0;  // points
    double outlier_px = 0;   // residuals far above it count no more
    double deviation_px = 0;
    bool is_least = false;  // it is what the residuals turn out to be, but no less than deviation_px
};

// What is compared, as a function of the numbers z: residuals, px, as many whatever z is.
using SilhouetteResiduals = std::function<std::vector<double>(const Eigen::VectorXd& z)>;

struct SilhouetteComparison {
    SilhouetteResiduals residuals;
    // By how much each number is moved to either side for slopes: far enough to look past the steps of the residuals.
    Eigen::VectorXd widths;
    // Where there is something quicker: the residuals beside z, as far as what decides them at z does so beside it.
    std::function<SilhouetteResiduals(const Eigen::VectorXd& z)> beside = nullptr;
};

// Remembers what it computed last, so that nothing is computed twice. For one thread; the comparison may use several.
class SilhouetteAdjustment {
public:
    SilhouetteAdjustment(SilhouetteComparison comparison, const SilhouetteErrors& errors)
        : comparison_(std::move(comparison)), errors_(errors) {}

    // From now on. `disbelief`: the variance of what was known before as it turns out, 1 unless given.
    void expect(const SilhouetteErrors& errors, double disbelief);

    const std::vector<double>& residuals(const Eigen::VectorXd& z);
    const Eigen::MatrixXd& slopes(const Eigen::VectorXd& z);  // of residuals, by central differences
    double cost(const Eigen::VectorXd& z);

    // Takes z to where the cost is least by Ceres' Levenberg-Marquardt, with at most so many steps and none that would
    // gain less than `enough`. False, and z stays, where residuals are not finite. Deterministic.
    bool improve(Eigen::VectorXd& z, int most_steps, double enough);

    // What the outlines alone show of the numbers: half the curvature of their part of the cost, [number, number].
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
