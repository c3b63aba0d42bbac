#include "rayspace/geometry/ring_axes.hpp"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

namespace rs {
namespace {

TEST(RingAxes, RotationsSurviveRounding) {
    const glm::dmat3 turned = glm::dmat3(glm::rotate(glm::dmat4(1), 2.5, glm::dvec3(1, -2, 0.5)));
    const glm::dmat3 read = ring_from_object(ring_rotation(turned));
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) EXPECT_NEAR(read[c][r], turned[c][r], 1e-8);
    }
    EXPECT_TRUE(ring_rotation(glm::dmat3(1)).is_identity());
    EXPECT_FALSE(ring_rotation(turned).is_identity());
}

TEST(RingAxes, CamerasKeepTheirPixels) {
    const Camera camera = look_at_camera({1, 4, 2}, {0, 0.2, 0}, 0.6, 64, 48);
    const RingRotation rotation = ring_rotation(glm::dmat3(glm::rotate(glm::dmat4(1), 1.1, glm::dvec3(0, 1, 1))));
    const Camera in_ring = in_ring_axes(camera, rotation);
    const glm::dvec3 p(0.3, -0.2, 0.5);
    const glm::dvec3 seen = camera.project(p);
    const glm::dvec3 seen_in_ring = in_ring.project(ring_from_object(rotation) * p);
    EXPECT_NEAR(seen.x, seen_in_ring.x, 1e-6);
    EXPECT_NEAR(seen.y, seen_in_ring.y, 1e-6);
    const Camera back = in_object_axes(in_ring, rotation);
    EXPECT_NEAR(glm::length(back.centre() - camera.centre()), 0, 1e-9);
}

}  // namespace
}  // namespace rs
