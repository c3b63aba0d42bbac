#include "capture/calibration/silhouettes/silhouette_fit.hpp"

#include "capture/calibration/silhouettes/silhouette_adjustment.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace rs::capture {
namespace {

// For slopes: wide enough to look past the steps of the distances, narrow enough for what is asked.
constexpr std::array<double, SilhouetteParameters::kCount> kWidths = {0.3, 0.004, 0.002, 0.02, 0.002};
// Of cost. The jackknife asks how the numbers move where one view in six is missing, which is worth little.
constexpr double kEnough = 1e-3;

// Shortfalls of rays by the free numbers.
class FittedRays final : public OutlineComparison {
public:
    FittedRays(const SilhouetteProblem& problem, const SilhouetteParameters& at, const RaySelection& rays)
        : problem_(problem), at_(at), rays_(rays) {
        for (std::size_t i = 0; i < SilhouetteParameters::kCount; ++i) {
            if (problem.free[i]) free_.push_back(i);
        }
    }

    [[nodiscard]] const std::vector<std::size_t>& free() const { return free_; }
    [[nodiscard]] SilhouetteParameters parameters(const Eigen::VectorXd& z) const {
        SilhouetteParameters all = at_;
        for (std::size_t k = 0; k < free_.size(); ++k) {
            all.value[free_[k]] = kSilhouettePriors[free_[k]] * z(static_cast<Eigen::Index>(k));
        }
        return all;
    }
    [[nodiscard]] Eigen::VectorXd start() const {
        return numbers([&](std::size_t name) { return at_.value[name] / kSilhouettePriors[name]; });
    }
    [[nodiscard]] OutlineErrors errors() const {
        const auto left_out =
            std::count_if(rays_.left_out.begin(), rays_.left_out.end(), [](char is) { return is != 0; });
        const auto views = static_cast<std::ptrdiff_t>(problem_.turn->views()) - left_out;
        return {kIndependentPerView * static_cast<double>(views), problem_.outlier_px, kSilhouetteError_px};
    }

    std::vector<double> residuals(const Eigen::VectorXd& z) override {
        return consistency_residuals_px(*problem_.turn, changed(problem_.start, parameters(z)), rays_);
    }
    [[nodiscard]] Eigen::VectorXd widths() const override {
        return numbers([](std::size_t name) { return kWidths[name] / kSilhouettePriors[name]; });
    }

private:
    template <typename Of>
    [[nodiscard]] Eigen::VectorXd numbers(const Of& of) const {
        Eigen::VectorXd z(static_cast<Eigen::Index>(free_.size()));
        for (std::size_t k = 0; k < free_.size(); ++k) z(static_cast<Eigen::Index>(k)) = of(free_[k]);
        return z;
    }

    const SilhouetteProblem& problem_;
    const SilhouetteParameters& at_;
    const RaySelection& rays_;
    std::vector<std::size_t> free_;
};

}  // namespace

TurntableModel changed(const TurntableModel& start, const SilhouetteParameters& by) {
    TurntableModel model = start;
    model.lens.f_px = start.lens.f_px * std::exp(by.value[SilhouetteParameters::kLogF]);
    model.pose.tilt_rad += by.value[SilhouetteParameters::kTilt];
    model.pose.roll_rad += by.value[SilhouetteParameters::kRoll];
    // In px, so that another f leaves the axis where it is in the picture. Panning right moves the axis left.
    const double axis_px = start.lens.f_px * std::tan(start.pose.pan_rad) - by.value[SilhouetteParameters::kAxis];
    model.pose.pan_rad = std::atan(axis_px / model.lens.f_px);
    for (double& angle : model.angles_rad) angle *= std::exp(by.value[SilhouetteParameters::kStep]);
    return model;
}

double silhouette_cost(const SilhouetteProblem& problem, const SilhouetteParameters& at, const RaySelection& rays) {
    FittedRays fitted(problem, at, rays);
    return OutlineAdjustment(fitted, fitted.errors()).cost(fitted.start());
}

SilhouetteFit fit_silhouettes(const SilhouetteProblem& problem, const SilhouetteParameters& at,
                              const RaySelection& rays, int iterations) {
    FittedRays fitted(problem, at, rays);
    OutlineAdjustment adjustment(fitted, fitted.errors());
    Eigen::VectorXd z = fitted.start();
    if (z.size() == 0) return {at, adjustment.cost(z), {}};
    adjustment.improve(z, iterations, kEnough);
    SilhouetteFit fit{fitted.parameters(z), adjustment.cost(z), {}};
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(z.size(), z.size());
    const Eigen::VectorXd left = (unit + adjustment.information(z)).inverse().diagonal().cwiseSqrt();
    for (Eigen::Index k = 0; k < z.size(); ++k) {
        const std::size_t name = fitted.free()[static_cast<std::size_t>(k)];
        const bool told = left(k) < kToldNothing;
        fit.deviation[name] = told ? left(k) * kSilhouettePriors[name] : std::numeric_limits<double>::infinity();
    }
    return fit;
}

}  // namespace rs::capture
