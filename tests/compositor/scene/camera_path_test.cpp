#include "compositor/scene/camera_path.hpp"

#include <gtest/gtest.h>

namespace rs::compositor {
namespace {

const std::vector<CameraPose> kKeys = {{{0, 0, 4}, {0, 0, 0}}, {{4, 1, 0}, {0, 1, 0}}, {{0, 2, -4}, {0, 0, 1}}};

TEST(CameraPath, AnOpenPathBeginsAndEndsAtItsKeysAndPassesThroughTheOthers) {
    const auto poses = poses_along({.keys = kKeys, .frames = 5});
    ASSERT_EQ(poses.size(), 5U);
    for (const std::size_t i : {0U, 1U, 2U}) {
        EXPECT_LT(glm::distance(poses[2 * i].eye, kKeys[i].eye), 1e-12);
        EXPECT_LT(glm::distance(poses[2 * i].at, kKeys[i].at), 1e-12);
    }
}

TEST(CameraPath, AClosedPathComesBack) {
    const auto poses = poses_along({.keys = kKeys, .frames = 300, .closed = true});
    ASSERT_EQ(poses.size(), 300U);
    EXPECT_LT(glm::distance(poses[100].eye, kKeys[1].eye), 1e-12);
    // No jumps, including the step from the last frame to the first.
    for (std::size_t i = 0; i < poses.size(); ++i) {
        EXPECT_LT(glm::distance(poses[i].eye, poses[(i + 1) % poses.size()].eye), 0.15) << i;
    }
}

TEST(CameraPath, OneKeyStandsStill) {
    for (const CameraPose& pose : poses_along({.keys = {kKeys[1]}, .frames = 3})) EXPECT_EQ(pose.eye, kKeys[1].eye);
}

TEST(PosesAround, KeepTheirDistanceAndHeightAndComeBack) {
    const CameraPose pose{{3, 2, 4}, {0, 1, 0}};
    const auto poses = poses_around(pose, 8);
    ASSERT_EQ(poses.size(), 8U);
    EXPECT_EQ(poses[0].eye, pose.eye);
    EXPECT_LT(glm::distance(poses[4].eye, glm::dvec3(-3, 2, -4)), 1e-12);
    for (const CameraPose& each : poses) EXPECT_NEAR(glm::distance(each.eye, each.at), std::sqrt(26.0), 1e-12);
}

}  // namespace
}  // namespace rs::compositor
