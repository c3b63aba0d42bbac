#include "capture/calibration/silhouettes/consistency_residuals.hpp"

#include "rayspace/base/conventions.hpp"
#include "tests/capture/calibration/drawn_figure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rs::capture {
namespace {

constexpr int kViewsOfCoherence = 20;

TurntableModel in_px_of(const SilhouetteTurn& turn, TurntableModel model) {
    model.lens.f_px /= turn.reduction();
    model.lens.cx /= turn.reduction();
    model.lens.cy /= turn.reduction();
    return model;
}

// Exhaustive reference: minimum distance over all views at many depths, refined around the best.
double plain_residual(const SilhouetteTurn& turn, const TurntableModel& model, std::size_t view, const glm::dvec2& edge,
                      double reach) {
    const auto direction = table_ray(model.lens, model.pose, edge);
    if (!direction) return 100;
    const auto least = [&](double depth) {
        double least_px = 1e9;
        for (std::size_t j = 0; j < turn.views(); ++j) {
            if (j == view) continue;
            const glm::dvec3 p = glm::dvec3(0, 0, 1) + depth * *direction;
            const auto seen = project(model.lens, model.pose, turned(p, model.angles_rad[j] - model.angles_rad[view]));
            if (!seen) return -1e9;
            const float distance = turn.distance(j, static_cast<float>(seen->x), static_cast<float>(seen->y));
            least_px = std::min(least_px, static_cast<double>(distance));
        }
        return least_px;
    };
    const double flat2 = direction->x * direction->x + direction->z * direction->z;
    const double middle = -direction->z / flat2;
    const double half = std::sqrt(std::max(1e-6, reach * reach - direction->x * direction->x / flat2) / flat2);
    double best = -1e9, at = middle;
    constexpr int kSteps = 400;
    for (int k = -kSteps; k <= kSteps; ++k) {
        const double depth = middle + half * k / kSteps;
        if (const double here = least(depth); here > best) {
            best = here;
            at = depth;
        }
    }
    for (int k = -200; k <= 200; ++k) best = std::max(best, least(at + half / kSteps * k / 100));
    return std::clamp(-best, 0.0, 100.0);
}

struct Scene {
    TurntableModel truth = turn_of_figure(kViewsOfCoherence);
    SilhouetteTurn turn = *SilhouetteTurn::create(drawn(figure(), truth), {300, 24});
};

TurntableModel bent(TurntableModel model) {
    model.pose.tilt_rad += radians(1.5);
    for (std::size_t i = 0; i < model.angles_rad.size(); ++i)
        model.angles_rad[i] += radians(0.7) * std::sin(3.0 * static_cast<double>(i));
    return model;
}

TEST(ConsistencyResiduals, ResidualsAreThoseOfPlainSearch) {
    const Scene scene;
    for (const TurntableModel& model : {in_px_of(scene.turn, scene.truth), in_px_of(scene.turn, bent(scene.truth))}) {
        const std::vector<double> fast = consistency_residuals_px(scene.turn, model, {});
        std::size_t at = 0;
        double sum = 0;
        for (std::size_t view = 0; view < scene.turn.views(); ++view) {
            for (const glm::dvec2& edge : scene.turn.edges(view)) {
                const double plain = plain_residual(scene.turn, model, view, edge, 0.25);
                // Golden-section search may end at a local maximum; the reference samples in steps and may miss the
                // maximum.
                EXPECT_LT(fast[at], plain + 0.1) << at;
                EXPECT_GT(fast[at], plain - 0.15) << at;
                sum += std::abs(fast[at] - plain);
                ++at;
            }
        }
        ASSERT_EQ(at, fast.size());
        EXPECT_LT(sum / static_cast<double>(at), 0.01);
    }
}

TEST(ConsistencyResiduals, WhatContradictsARayHereDoesSoBesideIt) {
    const Scene scene;
    const TurntableModel model = in_px_of(scene.turn, bent(scene.truth));
    RayDepths depths;
    const std::vector<double> here = consistency_residuals_px(scene.turn, model, {}, &depths);
    const std::vector<RayContradictions> verdicts = find_contradictions(scene.turn, model, {}, depths, 1.5, 8);
    const std::vector<double> again = residuals_from_contradictions(scene.turn, model, {}, verdicts);
    ASSERT_EQ(again.size(), here.size());
    std::size_t views = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
        EXPECT_NEAR(again[i], here[i], 0.1) << i;
        views += verdicts[i].views.size();
    }
    EXPECT_LT(static_cast<double>(views), 0.6 * kViewsOfCoherence * static_cast<double>(here.size()));

    TurntableModel beside = model;
    beside.pose.roll_rad += 0.002;
    const std::vector<double> whole = consistency_residuals_px(scene.turn, beside, {}, &depths);
    const std::vector<double> quick = residuals_from_contradictions(scene.turn, beside, {}, verdicts);
    double apart = 0, moved = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
        apart += std::abs(whole[i] - quick[i]);
        moved += std::abs(whole[i] - here[i]);
    }
    EXPECT_LT(apart, 0.05 * moved);
}

}  // namespace
}  // namespace rs::capture
