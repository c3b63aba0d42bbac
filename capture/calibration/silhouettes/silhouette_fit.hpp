#pragma once
// The few numbers of a turntable model that outlines can show, fitted to them.

#include "capture/calibration/silhouettes/consistency_residuals.hpp"

#include <array>
#include <optional>
#include <vector>

namespace rs::capture {

// Changes of a start model. In px of the SilhouetteTurn.
struct SilhouetteParameters {
    enum Name { kAxis, kTilt, kRoll, kLogF, kStep, kCount };
    // kAxis: shift of the axis across its direction, px, at the start's scale; kTilt, kRoll: rad; kLogF: log of the
    // factor of f; kStep: log of the factor of all angles.
    std::array<double, kCount> value{};
};

// Where nothing is known, what is plausible: one standard deviation of each change. Weak, so that only what outlines do
// not show is held by it.
inline constexpr std::array<double, SilhouetteParameters::kCount> kSilhouettePriors = {60, 0.5, 0.15, 0.35, 0.03};
// Outlines are off by about this much, in px of the turn, while angles are as assumed; the unit of costs.
inline constexpr double kSilhouetteError_px = 0.6;
// Where a deviation is above this share of the prior's, the outlines have shown nothing.
inline constexpr double kToldNothing = 0.7;

struct SilhouetteProblem {
    const SilhouetteTurn* turn = nullptr;
    TurntableModel start;  // in px of the turn
    std::array<bool, SilhouetteParameters::kCount> free{};
    double outlier_px = 3;  // residuals far above it count no more
};

TurntableModel changed(const TurntableModel& start, const SilhouetteParameters& by);

// Robust sum of squares in units of the assumed error, with the priors.
double silhouette_cost(const SilhouetteProblem& problem, const SilhouetteParameters& at, const RaySelection& rays);

struct SilhouetteFit {
    SilhouetteParameters at;
    double cost = 0;
    // One standard deviation by the curvature of the cost, [name]; infinity where the priors give it rather than the
    // outlines; 0 where held.
    std::array<double, SilhouetteParameters::kCount> deviation{};
};

// Levenberg-Marquardt with numeric derivatives from `at`. Deterministic.
SilhouetteFit fit_silhouettes(const SilhouetteProblem& problem, const SilhouetteParameters& at,
                              const RaySelection& rays, int iterations);

}  // namespace rs::capture
