#include "capture/calibration/silhouettes/silhouette_fit.hpp"

#include "capture/calibration/silhouettes/silhouette_adjustment.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace rs::capture {
namespace {

// Steps for finite differences: larger than the discretization of the distances, smaller than the required accuracy.
constexpr std::array<double, SilhouetteParameters::kCount> kWidths = {0.3, 0.004, 0.002, 0.02, 0.002};
// Function tolerance. The jackknife removes one view in six, whose effect need not be known more accurately.
constexpr double kEnough = 1e-3;

// The free numbers in units of their priors, and the comparison of rays.
struct FittedNumbers {
    std::vector<std::size_t> free;
    std::function<SilhouetteParameters(const Eigen::VectorXd& z)> at;
    Eigen::VectorXd start;
    SilhouetteAdjustment adjustment;
};

// Keeps all arguments by reference.
FittedNumbers numbers_of(const SilhouetteProblem& problem, const SilhouetteParameters& from, const RaySelection& rays) {
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < SilhouetteParameters::kCount; ++i) {
        if (problem.free[i]) free.push_back(i);
    }
    Eigen::VectorXd start(static_cast<Eigen::Index>(free.size())), widths = start;
    for (std::size_t k = 0; k < free.size(); ++k) {
        start(static_cast<Eigen::Index>(k)) = from.value[free[k]] / kSilhouettePriors[free[k]];
        widths(static_cast<Eigen::Index>(k)) = kWidths[free[k]] / kSilhouettePriors[free[k]];
    }
    const auto at = [&from, free](const Eigen::VectorXd& z) {
        SilhouetteParameters all = from;
        for (std::size_t k = 0; k < free.size(); ++k) {
            all.value[free[k]] = kSilhouettePriors[free[k]] * z(static_cast<Eigen::Index>(k));
        }
        return all;
    };
    const auto residuals = [&problem, &rays, at](const Eigen::VectorXd& z) {
        return consistency_residuals_px(*problem.turn, apply_changes(problem.start, at(z)), rays);
    };
    const auto left_out = std::count_if(rays.left_out.begin(), rays.left_out.end(), [](char is) { return is != 0; });
    const double views = static_cast<double>(problem.turn->views()) - static_cast<double>(left_out);
    const SilhouetteErrors errors{kIndependentPerView * views, problem.outlier_px, kSilhouetteError_px};
    return {free, at, start, SilhouetteAdjustment({residuals, widths}, errors)};
}

}  // namespace

TurntableModel apply_changes(const TurntableModel& start, const SilhouetteParameters& by) {
    TurntableModel model = start;
    model.lens.f_px = start.lens.f_px * std::exp(by.value[SilhouetteParameters::kLogF]);
    model.pose.tilt_rad += by.value[SilhouetteParameters::kTilt];
    model.pose.roll_rad += by.value[SilhouetteParameters::kRoll];
    // In px, so that the axis keeps its position in the image if f changes. Panning right moves the axis left.
    const double axis_px = start.lens.f_px * std::tan(start.pose.pan_rad) - by.value[SilhouetteParameters::kAxis];
    model.pose.pan_rad = std::atan(axis_px / model.lens.f_px);
    for (double& angle : model.angles_rad) angle *= std::exp(by.value[SilhouetteParameters::kStep]);
    return model;
}

double silhouette_cost(const SilhouetteProblem& problem, const SilhouetteParameters& at, const RaySelection& rays) {
    FittedNumbers numbers = numbers_of(problem, at, rays);
    return numbers.adjustment.cost(numbers.start);
}

SilhouetteFit fit_silhouettes(const SilhouetteProblem& problem, const SilhouetteParameters& at,
                              const RaySelection& rays, int iterations) {
    auto [free, found_at, z, adjustment] = numbers_of(problem, at, rays);
    if (free.empty()) return {at, adjustment.cost(z), {}};
    adjustment.improve(z, iterations, kEnough);
    SilhouetteFit fit{found_at(z), adjustment.cost(z), {}};
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(z.size(), z.size());
    const Eigen::VectorXd left = (unit + adjustment.information(z)).inverse().diagonal().cwiseSqrt();
    for (std::size_t k = 0; k < free.size(); ++k) {
        const double share = left(static_cast<Eigen::Index>(k));
        fit.deviation[free[k]] =
            share < kUndeterminedShare ? share * kSilhouettePriors[free[k]] : std::numeric_limits<double>::infinity();
    }
    return fit;
}

}  // namespace rs::capture
