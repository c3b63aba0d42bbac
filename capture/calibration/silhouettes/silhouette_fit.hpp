#pragma once
// Fits the few numbers of a turntable model that silhouettes can determine.

#include "capture/calibration/silhouettes/consistency_residuals.hpp"

#include <array>
#include <optional>
#include <vector>

namespace rs::capture {

/// Changes of a start model, in px of the SilhouetteTurn.
struct SilhouetteParameters {
    enum Name { kAxis, kTilt, kRoll, kLogF, kStep, kCount };
    /// kAxis: shift of the axis across its direction, px, at the start's scale; kTilt, kRoll: rad; kLogF: log of the
    /// factor of f; kStep: log of the factor of all angles.
    std::array<double, kCount> value{};
};

/// Priors: one standard deviation of each change. Weak, so that they only affect numbers that the silhouettes do not
/// determine.
inline constexpr std::array<double, SilhouetteParameters::kCount> kSilhouettePriors = {60, 0.5, 0.15, 0.35, 0.03};
/// Typical error of silhouettes in px of the turn while angles are assumed; the unit of costs.
inline constexpr double kSilhouetteError_px = 0.6;
/// A deviation above this share of the prior's counts as undetermined by the silhouettes.
inline constexpr double kUndeterminedShare = 0.7;

struct SilhouetteProblem {
    const SilhouetteTurn* turn = nullptr;
    TurntableModel start;  // in px of the turn
    std::array<bool, SilhouetteParameters::kCount> free{};
    double outlier_px = 3;  // larger residuals have little weight
};

TurntableModel apply_changes(const TurntableModel& start, const SilhouetteParameters& by);

/// Robust sum of squares in units of the assumed error, plus the priors.
double silhouette_cost(const SilhouetteProblem& problem, const SilhouetteParameters& at, const RaySelection& rays);

struct SilhouetteFit {
    SilhouetteParameters at;
    double cost = 0;
    /// One standard deviation from the curvature of the cost, [name]; infinity if it comes from the priors instead of
    /// the silhouettes; 0 if constant.
    std::array<double, SilhouetteParameters::kCount> deviation{};
};

/// Levenberg-Marquardt with numeric derivatives from `at`. Deterministic.
SilhouetteFit fit_silhouettes(const SilhouetteProblem& problem, const SilhouetteParameters& at,
                              const RaySelection& rays, int iterations);

}  // namespace rs::capture
