#include "compositor/scene/transform.hpp"

#include "rayspace/base/conventions.hpp"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <random>

namespace rs::compositor {
namespace {

// Matrix of one node, from glm's transforms.
glm::dmat4 explicit_matrix(const NodeTransform& node) {
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), node.translation);
    return glm::scale(glm::rotate(moved, node.angle_rad, node.axis), glm::dvec3(node.scale));
}

NodeTransform random_node(std::mt19937_64& random) {
    std::uniform_real_distribution<double> number(-3, 3);
    std::uniform_real_distribution<double> scale(0.2, 4);
    return {{number(random), number(random), number(random)},
            {number(random), number(random) + 4, number(random)},
            number(random),
            scale(random)};
}

TEST(Equation3, IsTheExplicitChainOfInverses) {
    constexpr std::uint64_t kSeed = 3;
    SCOPED_TRACE(kSeed);
    std::mt19937_64 random(kSeed);
    for (int trial = 0; trial < 100; ++trial) {
        const NodeTransform t1 = random_node(random);
        const NodeTransform t2 = random_node(random);
        const NodeTransform t3 = random_node(random);
        const NodeTransform t5 = random_node(random);
        const glm::dvec3 p1(0.3, -1, trial);
        const glm::dvec4 p5 = glm::inverse(explicit_matrix(t5)) * glm::inverse(explicit_matrix(t3)) *
                              glm::inverse(explicit_matrix(t2)) * explicit_matrix(t1) * glm::dvec4(p1, 1);
        const Camera above = look_at_camera(world_from_node({t1}).point(p1), {0, 0, 0}, 1, 8, 8);
        const glm::dvec3 found = camera_in_node(above, world_from_node({t2, t3, t5})).centre();
        EXPECT_LT(glm::distance(found, glm::dvec3(p5)), 1e-9 * (1 + glm::length(glm::dvec3(p5))));
    }
}

TEST(Similarity, InverseUndoesIt) {
    std::mt19937_64 random(5);
    const Similarity b_from_a = random_node(random).parent_from_node();
    const glm::dvec3 p(1, 2, 3);
    EXPECT_LT(glm::distance((b_from_a.inverse() * b_from_a).point(p), p), 1e-12);
    EXPECT_LT(glm::distance(glm::dvec3(b_from_a.matrix() * glm::dvec4(p, 1)), b_from_a.point(p)), 1e-12);
}

TEST(CameraInNode, SeesThePointsOfTheNodeWhereTheWorldsCameraSeesThem) {
    std::mt19937_64 random(7);
    const Camera camera = look_at_camera({0, 1, 9}, {1, 0, -1}, radians(60), 640, 480);
    for (int trial = 0; trial < 20; ++trial) {
        const Similarity world_from_object = world_from_node({random_node(random), random_node(random)});
        const Camera inside = camera_in_node(camera, world_from_object);
        EXPECT_LT(rotation_error(inside), 1e-12);
        const glm::dvec3 p(0.3, -0.2, 0.7);
        const glm::dvec3 in_world = camera.project(world_from_object.point(p));
        const glm::dvec3 in_object = inside.project(p);
        EXPECT_NEAR(in_object.x, in_world.x, 1e-6 * (1 + std::abs(in_world.x)));
        EXPECT_NEAR(in_object.y, in_world.y, 1e-6 * (1 + std::abs(in_world.y)));
        EXPECT_NEAR(in_object.z * world_from_object.scale, in_world.z, 1e-9);
    }
}

TEST(CameraInNode, StaysExactlyUprightUnderTurnsAboutY) {
    const Camera camera = look_at_camera({1, 2, 9}, {0.3, 2, 0}, radians(60), 640, 480);
    const Similarity world_from_object =
        world_from_node({{{1, 2, 3}, {0, 1, 0}, 0.7, 2}, {{0, 0, 1}, {0, 3, 0}, -2.1}});
    EXPECT_EQ(camera_in_node(camera, world_from_object).up(), glm::dvec3(0, 1, 0));
}

}  // namespace
}  // namespace rs::compositor
