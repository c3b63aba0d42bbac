#include "capture/calibration/model/turn_projection.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::capture {
namespace {

TurntableModel tilted_turn() {
    TurntableModel model;
    model.lens = {640, 480, 700, 322, 238, -0.12, 0.03};
    model.pose = {0.04, 0.3, -0.02};
    for (int i = 0; i < 7; ++i) model.angles_rad.push_back(0.9 * i);
    return model;
}

const glm::dvec3 kPoint(0.11, -0.24, 0.07);

TEST(TurnProjection, ShowsPointsWhereTheModelDoes) {
    const TurntableModel model = tilted_turn();
    const TurnProjection turn(model);
    for (std::size_t view = 0; view < model.angles_rad.size(); ++view) {
        const auto expected = project(model.lens, model.pose, turned(kPoint, model.angles_rad[view]));
        const auto found = turn.project(kPoint, view);
        ASSERT_TRUE(expected && found);
        EXPECT_LT(glm::distance(*expected, *found), 1e-9);
        EXPECT_FALSE(turn.project(10.0 * turn.centre(view), view).has_value());  // behind the camera
    }
}

TEST(TurnProjection, SlopesAreDifferences) {
    const TurnProjection turn(tilted_turn());
    constexpr double kStep = 1e-6;
    const auto moving = turn.project_with_jacobian(kPoint, 3);
    ASSERT_TRUE(moving.has_value());
    EXPECT_LT(glm::distance(moving->px, *turn.project(kPoint, 3)), 1e-9);
    for (int k = 0; k < 3; ++k) {
        glm::dvec3 step(0);
        step[k] = kStep;
        const glm::dvec2 slope = (*turn.project(kPoint + step, 3) - *turn.project(kPoint - step, 3)) / (2 * kStep);
        EXPECT_NEAR(moving->slope_x[k], slope.x, 1e-4);
        EXPECT_NEAR(moving->slope_y[k], slope.y, 1e-4);
    }
}

TEST(TurnProjection, RaysGoThroughWhatIsSeen) {
    const TurnProjection turn(tilted_turn());
    for (std::size_t view = 0; view < 7; ++view) {
        const auto ray = turn.ray(*turn.project(kPoint, view), view);
        ASSERT_TRUE(ray.has_value());
        EXPECT_NEAR(glm::length(*ray), 1, 1e-12);
        EXPECT_LT(glm::length(glm::cross(*ray, kPoint - turn.centre(view))), 1e-9);
        EXPECT_GT(glm::dot(*ray, kPoint - turn.centre(view)), 0);
    }
}

}  // namespace
}  // namespace rs::capture
