#include "capture/turns/turn_placement.hpp"

#include "tests/capture/turns/turn_scene.hpp"

#include <gtest/gtest.h>

namespace rs::capture {
namespace {

TEST(TurnPlacement, CameraSeesPointsWhereTheModelProjectsThem) {
    const PlacedTurn turn = test::two_turns()[1];
    const glm::dvec3 p(0.1, -0.05, 0.03);
    for (const std::size_t view : {0U, 5U}) {
        const glm::dvec3 in_table = turned(turn.placement.turn_from_common(p), turn.model.angles_rad[view]);
        const auto expected = project(turn.model.lens, turn.model.pose, in_table);
        ASSERT_TRUE(expected);
        const glm::dvec3 seen = common_camera(turn, view).project(p);
        EXPECT_NEAR(seen.x, expected->x, 1e-9);
        EXPECT_NEAR(seen.y, expected->y, 1e-9);
    }
    EXPECT_LT(glm::length(turn.placement.common_from_turn(turn.placement.turn_from_common(p)) - p), 1e-12);
    EXPECT_NEAR(degrees(azimuth_rad(turn.placement)), 130, 1e-9);
}

TEST(TurnPlacement, AimIsTheInverseOfItsPlacement) {
    const CameraAim aim{radians(80), 1.2, 0.03};
    PlacedTurn turn{test::turn_model(80), aimed_placement(1, aim, 0.4)};
    const CameraAim found = aim_of(turn, 0.4);
    EXPECT_NEAR(found.slant, aim.slant, 1e-12);
    EXPECT_NEAR(found.shift, aim.shift, 1e-12);
}

TEST(TurnPlacement, ElevationIsAboutTheOwnAxisOfALyingTurn) {
    PlacedTurn turn = test::two_turns()[1];
    const double upright_deg = elevation_deg(turn, {0, 0, 0});
    EXPECT_TRUE(turn.placement.is_upright());
    EXPECT_NEAR(axis_tilt_deg(turn.placement), 0, 1e-5);
    const glm::dmat3 quarter(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
    turn.placement.rotation = turn.placement.rotation * quarter;  // about the origin of the common frame
    EXPECT_FALSE(turn.placement.is_upright());
    EXPECT_NEAR(axis_tilt_deg(turn.placement), 90, 1e-9);
    EXPECT_NEAR(elevation_deg(turn, {0, 0, 0}), upright_deg, 1e-9);
}

}  // namespace
}  // namespace rs::capture
