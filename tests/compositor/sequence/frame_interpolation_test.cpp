#include "compositor/sequence/sequence.hpp"

#include "tests/compositor/moving_boxes.hpp"

#include <gtest/gtest.h>

namespace rs::compositor {
namespace {

// The pose of the only box at `time`, between two poses.
InstancePose between(const InstancePose& first, const InstancePose& second, double time) {
    auto sequence = *test::moving_boxes(1, 2);
    sequence.frames[0].poses = {{0, false, first}};
    sequence.frames[1].poses = {{0, false, second}};
    return frame_at(sequence, time).poses.at(0).pose;
}

double distance(const glm::dmat3& a, const glm::dmat3& b) {
    double greatest = 0;
    for (int i = 0; i < 3; ++i) greatest = std::max(greatest, glm::distance(a[i], b[i]));
    return greatest;
}

TEST(FrameInterpolation, MovesLinearlyAndTurnsTheShortWay) {
    const InstancePose first{{0, 1, 0}, {0, 350, 0}, {1, 1, 1}};
    const InstancePose second{{4, 1, 0}, {0, 30, 0}, {3, 1, 1}};
    const InstancePose quarter = between(first, second, 0.25);
    EXPECT_EQ(quarter.move, glm::dvec3(1, 1, 0));
    EXPECT_EQ(quarter.scale, glm::dvec3(1.5, 1, 1));
    EXPECT_LT(distance(turn_matrix(quarter.turn_deg), turn_matrix({0, 0, 0})), 1e-9);
    // Other angles of the same rotation do not turn.
    const InstancePose same{{0, 1, 0}, {180, 190, 180}, {1, 1, 1}};
    EXPECT_LT(distance(turn_matrix(between(first, same, 0.5).turn_deg), turn_matrix(first.turn_deg)), 1e-9);
    // A rotation about an oblique axis, and one that ends where the angles lock.
    for (const glm::dvec3& end : {glm::dvec3(40, 50, -70), glm::dvec3(0, 90, 20)}) {
        const InstancePose turned{{0, 0, 0}, end, {1, 1, 1}};
        const InstancePose almost = between(InstancePose{}, turned, 1 - 1e-12);
        EXPECT_LT(distance(turn_matrix(almost.turn_deg), turn_matrix(end)), 1e-5);
    }
}

TEST(FrameInterpolation, WholeFramesAndEqualPosesAreExact) {
    const auto sequence = *test::moving_boxes(2, 3);
    const InstancePose pose{{0.1, 0.7, 0.3}, {11, 350, 7}, {1.1, 1.2, 1.3}};
    EXPECT_EQ(between(pose, pose, 0.3), pose);
    EXPECT_EQ(frame_at(sequence, 2).poses[0].pose, sequence.frames[2].poses[0].pose);
    EXPECT_EQ(frame_at(sequence, 2.9).poses[0].pose, sequence.frames[2].poses[0].pose);
    EXPECT_NEAR(frame_at(sequence, 0.5).camera->pose.at.x, 0.05, 1e-12);
    // The second frame shows one of the two boxes.
    EXPECT_EQ(frame_at(sequence, 0.5).poses[0].pose, sequence.frames[0].poses[0].pose);
}

}  // namespace
}  // namespace rs::compositor
