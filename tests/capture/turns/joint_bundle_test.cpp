#include "capture/turns/joint_bundle.hpp"

#include "tests/capture/turns/turn_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rs::capture {
namespace {

ModelDeviations turn_deviations(std::size_t views) {
    ModelDeviations known;
    known.f_px = 4;
    known.cx = known.cy = known.k1 = known.k2 = 0;
    known.axis_direction_rad = known.tilt_rad = known.roll_rad = radians(0.2);
    known.axis_position_px = 0.3;
    known.angles_rad.assign(views, radians(0.05));
    return known;
}

TEST(JointBundle, RecoversPlacementAndTiltOfTheSecondTurn) {
    const std::vector<PlacedTurn> truth = test::two_turns();
    JointBundle bundle{truth, {turn_deviations(12), turn_deviations(12)}, {}};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> side(-0.15, 0.15);
    for (int k = 0; k < 80; ++k) {
        JointTrack track;
        const glm::dvec3 p(side(random), side(random), side(random));
        track.point = p + glm::dvec3(0.004, -0.003, 0.002);
        for (std::size_t t = 0; t < 2; ++t) {
            for (std::size_t i = 0; i < 4; ++i) {
                const glm::dvec3 px = common_camera(truth[t], i).project(p);
                track.seen.push_back({t, i, glm::dvec2(px.x, px.y) + (k == 0 ? glm::dvec2(25, 0) : glm::dvec2(0))});
            }
        }
        bundle.tracks.push_back(track);
    }
    bundle.turns[1].model.pose.tilt_rad += radians(0.2);
    bundle.turns[1].placement =
        upright_placement(radians(131), 1.02 * truth[1].placement.distance, -truth[1].placement.offset.y + 0.01);
    const auto fits = adjust_jointly(bundle, 0);
    ASSERT_TRUE(fits.ok()) << fits.error().message;
    EXPECT_NEAR(degrees(azimuth_rad(bundle.turns[1].placement)), 130, 0.02);
    EXPECT_NEAR(bundle.turns[1].placement.distance, truth[1].placement.distance, 1e-3);
    EXPECT_NEAR(bundle.turns[1].placement.offset.y, truth[1].placement.offset.y, 1e-3);
    EXPECT_NEAR(degrees(bundle.turns[1].model.pose.tilt_rad), 35, 0.05);
    EXPECT_EQ(bundle.turns[0].placement.distance, 1);
    EXPECT_EQ(bundle.tracks.size(), 79U);  // without the outlier
    EXPECT_LT((*fits)[1].rms_px, 0.1);
}

TEST(JointBundle, RecoversTheOrientationOfALyingTurn) {
    std::vector<PlacedTurn> truth = test::two_turns();
    const auto about_z = [](double angle_deg) {
        const double c = std::cos(radians(angle_deg)), s = std::sin(radians(angle_deg));
        return glm::dmat3(glm::dvec3(c, s, 0), glm::dvec3(-s, c, 0), glm::dvec3(0, 0, 1));
    };
    truth[1].placement.rotation = about_z(80) * truth[1].placement.rotation;
    truth[1].placement.offset += glm::dvec3(0.02, 0, -0.03);
    JointBundle bundle{truth, {turn_deviations(12), turn_deviations(12)}, {}};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> side(-0.15, 0.15);
    for (int k = 0; k < 80; ++k) {
        JointTrack track;
        const glm::dvec3 p(side(random), side(random), side(random));
        track.point = p + glm::dvec3(0.004, -0.003, 0.002);
        for (std::size_t t = 0; t < 2; ++t) {
            for (std::size_t i = 0; i < 4; ++i) {
                const glm::dvec3 px = common_camera(truth[t], i).project(p);
                track.seen.push_back({t, i, {px.x, px.y}});
            }
        }
        bundle.tracks.push_back(track);
    }
    bundle.turns[1].placement.rotation = about_z(81.5) * glm::transpose(about_z(80)) * truth[1].placement.rotation;
    bundle.turns[1].placement.offset += glm::dvec3(-0.01, 0.01, 0.01);
    const auto fits = adjust_jointly(bundle, 0);
    ASSERT_TRUE(fits.ok()) << fits.error().message;
    const TurnPlacement& found = bundle.turns[1].placement;
    for (int k = 0; k < 3; ++k) EXPECT_LT(glm::length(found.rotation[k] - truth[1].placement.rotation[k]), 1e-3);
    EXPECT_LT(glm::length(found.offset - truth[1].placement.offset), 1e-3);
    EXPECT_EQ(bundle.tracks.size(), 80U);
}

}  // namespace
}  // namespace rs::capture
