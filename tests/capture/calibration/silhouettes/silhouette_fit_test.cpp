#include "capture/calibration/silhouettes/silhouette_fit.hpp"

#include "rayspace/base/conventions.hpp"
#include "tests/capture/calibration/drawn_figure.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::capture {
namespace {

TEST(SilhouetteFit, FindsAKnownOffsetWithinItsDeviations) {
    TurntableModel truth = turn_of_figure(16);
    const SilhouetteTurn turn = *SilhouetteTurn::create(drawn(figure(), truth));
    for (double* const px : {&truth.lens.f_px, &truth.lens.cx, &truth.lens.cy}) *px /= turn.reduction();
    SilhouetteParameters off;  // changes are additive, so the fit must undo them
    off.value[SilhouetteParameters::kAxis] = 5;
    off.value[SilhouetteParameters::kTilt] = radians(-4);
    off.value[SilhouetteParameters::kRoll] = radians(1.5);
    off.value[SilhouetteParameters::kStep] = 0.008;
    const SilhouetteProblem problem{&turn, apply_changes(truth, off), {true, true, true, false, true}};

    const RaySelection rays{2, {}};
    const SilhouetteFit fit = fit_silhouettes(problem, {}, rays, 30);
    EXPECT_LT(fit.cost, 0.05 * silhouette_cost(problem, {}, rays));
    EXPECT_NEAR(fit.cost, silhouette_cost(problem, fit.at, rays), 1e-9 * fit.cost);
    // Largest useful deviations: px, rad, rad, -, -.
    constexpr std::array<double, SilhouetteParameters::kCount> kUseful = {0.3, 0.02, 0.005, 0, 0.005};
    for (std::size_t i = 0; i < SilhouetteParameters::kCount; ++i) {
        if (!problem.free[i]) {
            EXPECT_EQ(fit.at.value[i], 0);
            EXPECT_EQ(fit.deviation[i], 0);
            continue;
        }
        EXPECT_LT(std::abs(fit.at.value[i] + off.value[i]), 2 * fit.deviation[i]) << i;
        EXPECT_LT(std::abs(fit.at.value[i] + off.value[i]), 0.15 * std::abs(off.value[i])) << i;
        EXPECT_GT(fit.deviation[i], 0) << i;
        EXPECT_LT(fit.deviation[i], kUseful[i]) << i;
    }
}

}  // namespace
}  // namespace rs::capture
