#include "capture/calibration/silhouettes/silhouette_fit.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rs::capture {
namespace {

// Neighbouring points of an outline are off alike: a view is worth this many independent ones.
constexpr double kIndependentPerView = 8;

// For derivatives: wide enough to look past the steps of the distances, narrow enough for what is asked.
constexpr std::array<double, SilhouetteParameters::kCount> kSteps = {0.3, 0.004, 0.002, 0.02, 0.002};

// Weight of one ray's squared residual.
double ray_weight(const SilhouetteProblem& problem, const RaySelection& rays, std::size_t count) {
    std::size_t views = problem.turn->views();
    for (const char left_out : rays.left_out) views -= left_out != 0 ? 1 : 0;
    return kIndependentPerView * static_cast<double>(views) /
           (static_cast<double>(count) * kSilhouetteError_px * kSilhouetteError_px);
}

double prior_cost(const SilhouetteProblem& problem, const SilhouetteParameters& at) {
    double cost = 0;
    for (std::size_t i = 0; i < SilhouetteParameters::kCount; ++i) {
        const double z = at.value[i] / kSilhouettePriors[i];
        if (problem.free[i]) cost += z * z;
    }
    return cost;
}

// Geman-McClure.
double robust_sum(const std::vector<double>& residuals, double outlier_px) {
    double sum = 0;
    for (const double s : residuals) sum += s * s / (1 + s * s / (outlier_px * outlier_px));
    return sum;
}

double cost_of(const SilhouetteProblem& problem, const SilhouetteParameters& at, const RaySelection& rays,
               const std::vector<double>& residuals) {
    return ray_weight(problem, rays, residuals.size()) * robust_sum(residuals, problem.outlier_px) +
           prior_cost(problem, at);
}

std::vector<double> residuals_at(const SilhouetteProblem& problem, const SilhouetteParameters& at,
                                 const RaySelection& rays) {
    return consistency_residuals_px(*problem.turn, changed(problem.start, at), rays);
}

struct Normals {
    Eigen::MatrixXd data;      // J^T W J of the residuals
    Eigen::VectorXd gradient;  // of data and priors, halved
};

Normals normals_at(const SilhouetteProblem& problem, const SilhouetteParameters& at, const RaySelection& rays,
                   const std::vector<std::size_t>& free, const std::vector<double>& residuals) {
    const auto rows = static_cast<Eigen::Index>(residuals.size());
    const auto columns = static_cast<Eigen::Index>(free.size());
    Eigen::MatrixXd jacobian(rows, columns);
    for (Eigen::Index c = 0; c < columns; ++c) {
        const std::size_t name = free[static_cast<std::size_t>(c)];
        SilhouetteParameters before = at;
        SilhouetteParameters behind = at;
        before.value[name] -= kSteps[name];
        behind.value[name] += kSteps[name];
        const auto low = residuals_at(problem, before, rays);
        const auto high = residuals_at(problem, behind, rays);
        for (Eigen::Index r = 0; r < rows; ++r) {
            const auto k = static_cast<std::size_t>(r);
            jacobian(r, c) = (high[k] - low[k]) / (2 * kSteps[name]);
        }
    }
    Eigen::VectorXd weight(rows);
    Eigen::VectorXd residual(rows);
    const double per_ray = ray_weight(problem, rays, residuals.size());
    for (Eigen::Index r = 0; r < rows; ++r) {
        const double s = residuals[static_cast<std::size_t>(r)];
        const double tail = 1 + s * s / (problem.outlier_px * problem.outlier_px);
        weight(r) = per_ray / (tail * tail);
        residual(r) = s;
    }
    Normals normals;
    normals.data = jacobian.transpose() * weight.asDiagonal() * jacobian;
    normals.gradient = jacobian.transpose() * weight.asDiagonal() * residual;
    for (Eigen::Index c = 0; c < columns; ++c) {
        const std::size_t name = free[static_cast<std::size_t>(c)];
        normals.gradient(c) += at.value[name] / (kSilhouettePriors[name] * kSilhouettePriors[name]);
    }
    return normals;
}

Eigen::MatrixXd with_priors(Eigen::MatrixXd data, const std::vector<std::size_t>& free) {
    for (std::size_t i = 0; i < free.size(); ++i) {
        const auto c = static_cast<Eigen::Index>(i);
        data(c, c) += 1 / (kSilhouettePriors[free[i]] * kSilhouettePriors[free[i]]);
    }
    return data;
}

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
    return cost_of(problem, at, rays, residuals_at(problem, at, rays));
}

SilhouetteFit fit_silhouettes(const SilhouetteProblem& problem, const SilhouetteParameters& at,
                              const RaySelection& rays, int iterations) {
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < SilhouetteParameters::kCount; ++i) {
        if (problem.free[i]) free.push_back(i);
    }
    SilhouetteFit fit{at, 0, {}};
    std::vector<double> residuals = residuals_at(problem, at, rays);
    fit.cost = cost_of(problem, at, rays, residuals);
    if (free.empty()) return fit;

    double damping = 1e-2;
    Normals normals = normals_at(problem, fit.at, rays, free, residuals);
    for (int i = 0; i < iterations; ++i) {
        const Eigen::MatrixXd full = with_priors(normals.data, free);
        bool better = false;
        bool small = false;
        for (int attempt = 0; attempt < 5 && !better; ++attempt) {
            Eigen::MatrixXd damped = full;
            damped.diagonal() *= 1 + damping;
            const Eigen::VectorXd step = damped.ldlt().solve(-normals.gradient);
            SilhouetteParameters next = fit.at;
            small = true;
            for (std::size_t k = 0; k < free.size(); ++k) {
                const double change = step(static_cast<Eigen::Index>(k));
                next.value[free[k]] += change;
                small = small && std::abs(change) < 0.02 * kSteps[free[k]];
            }
            const std::vector<double> tried = residuals_at(problem, next, rays);
            const double cost = cost_of(problem, next, rays, tried);
            better = cost < fit.cost;
            damping = better ? std::max(damping / 5, 1e-6) : damping * 6;
            if (better) {
                fit.at = next;
                fit.cost = cost;
                residuals = tried;
            }
        }
        if (!better) break;
        normals = normals_at(problem, fit.at, rays, free, residuals);
        if (small) break;
    }

    const Eigen::MatrixXd covariance = with_priors(normals.data, free).inverse();
    for (std::size_t k = 0; k < free.size(); ++k) {
        const auto c = static_cast<Eigen::Index>(k);
        const double deviation = std::sqrt(std::max(0.0, covariance(c, c)));
        const bool told = deviation < kToldNothing * kSilhouettePriors[free[k]];
        fit.deviation[free[k]] = told ? deviation : std::numeric_limits<double>::infinity();
    }
    return fit;
}

}  // namespace rs::capture
