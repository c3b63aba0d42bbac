// Ray geometry over random rays, viewpoints and cameras; the seed of a failing case is printed.

#include "rayspace/geometry/ray_space.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/support/plane_ray.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rs {
namespace {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    int in(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
    glm::dvec3 direction() {
        glm::dvec3 v;
        do v = {in(-1.0, 1.0), in(-1.0, 1.0), in(-1.0, 1.0)};
        while (glm::length(v) < 0.1 || glm::length(v) > 1 || std::hypot(v.x, v.z) < 0.05);
        return glm::normalize(v);
    }

private:
    std::mt19937_64 engine_;
};

double distance_point_to_ray(const glm::dvec3& p, const test::Ray& ray) {
    const glm::dvec3 d = glm::normalize(ray.direction);
    return glm::length(glm::cross(p - ray.origin, d));
}

TEST(ReferencePlane, FollowsTheConvention) {
    const ReferencePlane first = reference_plane(0, 12);
    EXPECT_NEAR(glm::distance(first.normal, glm::dvec3(0, 0, 1)), 0, 1e-15);
    EXPECT_NEAR(glm::distance(first.tangent, glm::dvec3(1, 0, 0)), 0, 1e-15);
    const ReferencePlane quarter = reference_plane(3, 12);  // turned from +Z towards +X
    EXPECT_NEAR(glm::distance(quarter.normal, glm::dvec3(1, 0, 0)), 0, 1e-15);
    EXPECT_NEAR(glm::distance(quarter.tangent, glm::dvec3(0, 0, -1)), 0, 1e-15);
    for (int k = 0; k < 12; ++k) {
        const ReferencePlane plane = reference_plane(k, 12);
        // tangent, Y and normal are a right-handed frame.
        EXPECT_NEAR(glm::distance(glm::cross(plane.tangent, glm::dvec3(0, 1, 0)), plane.normal), 0, 1e-12);
    }
}

TEST(RaySpaceProperty, RayGoesThereAndBack) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const int count = random.in(3, 24);
        const test::Ray ray{{random.in(-4.0, 4.0), random.in(-2.0, 2.0), random.in(-4.0, 4.0)}, random.direction()};
        const ReferencePlane plane = reference_plane(test::most_perpendicular_plane(ray.direction, count), count);
        const auto in_ray_space = test::to_ray_space(ray, plane);
        ASSERT_TRUE(in_ray_space);
        EXPECT_LE(std::abs(in_ray_space->u), std::tan(kPi / count) + 1e-9);
        const test::Ray back = test::from_ray_space(*in_ray_space, plane, random.in(0.5, 5.0));
        EXPECT_NEAR(glm::dot(glm::normalize(back.direction), ray.direction), 1, 1e-12);
        EXPECT_NEAR(distance_point_to_ray(ray.origin, back), 0, 1e-9);
    }
}

TEST(RaySpaceProperty, TheRaysOfAViewpointLieOnItsLine) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const glm::dvec3 viewpoint(random.in(-5.0, 5.0), random.in(-2.0, 2.0), random.in(-5.0, 5.0));
        const int count = random.in(3, 16);
        const ReferencePlane plane = reference_plane(random.in(0, count - 1), count);
        const ViewpointLine line = viewpoint_line(viewpoint, plane);
        for (int n = 0; n < 20; ++n) {
            const test::Ray ray{viewpoint, random.direction()};
            const auto point = test::to_ray_space(ray, plane);
            if (!point) continue;
            EXPECT_NEAR(point->x, line.a + point->u * line.c, 1e-9);
            // And the point (x, y) of the plane is on the ray.
            const glm::dvec3 p = point->x * plane.tangent + glm::dvec3(0, point->y, 0);
            EXPECT_NEAR(distance_point_to_ray(p, ray), 0, 1e-7);
        }
    }
}

TEST(RaySpace, RaysFromBehindThePlaneHaveNoPlace) {
    const ReferencePlane plane = reference_plane(0, 4);
    EXPECT_FALSE(test::to_ray_space({{0, 0, 3}, {0, 0, 1}}, plane));
    EXPECT_FALSE(test::to_ray_space({{0, 0, 3}, {1, 0, 0}}, plane));
    EXPECT_TRUE(test::to_ray_space({{0, 0, 3}, {0, 0, -1}}, plane));
}

TEST(VerticalCompensation, IsThePapersEquationForCamerasAtTheAxisHeight) {
    EXPECT_DOUBLE_EQ(test::compensated_slope(0.25, 0, 3, 0, 4), 0.25 * 3 / 4);
}

TEST(VerticalCompensationProperty, BothCamerasSeeOnePoint) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const double fov = radians(random.in(15.0, 60.0));
        const auto camera_at = [&] {
            const double angle = random.in(0.0, 2 * kPi), distance = random.in(2.5, 6.0), height = random.in(-1.0, 1.0);
            const glm::dvec3 eye(distance * std::sin(angle), height, distance * std::cos(angle));
            return look_at_camera(eye, {0, height, 0}, fov, 640, 480);
        };
        const Camera p = camera_at();
        const Camera q = camera_at();
        const glm::dvec3 point(random.in(-0.5, 0.5), random.in(-1.0, 1.0), random.in(-0.5, 0.5));
        const glm::dvec3 in_p = p.project(point), in_q = q.project(point);
        const double slope_p = (p.cy - in_p.y) / p.fl_y;
        const double slope_q = (q.cy - in_q.y) / q.fl_y;
        EXPECT_NEAR(test::compensated_slope(slope_p, p.centre().y, in_p.z, q.centre().y, in_q.z), slope_q, 1e-9);
    }
}

TEST(RectificationProperty, TheUprightCameraSeesTheSameRays) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const double angle = random.in(0.0, 2 * kPi);
        const glm::dvec3 eye(4 * std::sin(angle), random.in(-3.0, 3.0), 4 * std::cos(angle));
        const Camera camera =
            look_at_camera(eye, {random.in(-0.2, 0.2), random.in(-0.2, 0.2), 0}, radians(40), 640, 480);
        const Camera upright = upright_camera(camera);
        EXPECT_TRUE(is_upright(upright));
        EXPECT_LT(rotation_error(upright), 1e-12);
        EXPECT_NEAR(glm::distance(upright.centre(), camera.centre()), 0, 1e-12);

        const glm::dmat3 to_upright = pixel_in_to_from_pixel_in_from(upright, camera);
        const double x = random.in(0.0, 640.0), y = random.in(0.0, 480.0);
        const glm::dvec3 p = to_upright * glm::dvec3(x, y, 1);
        const glm::dvec3 ray = camera.ray(x, y);
        EXPECT_NEAR(glm::dot(glm::normalize(ray), glm::normalize(upright.ray(p.x / p.z, p.y / p.z))), 1, 1e-12);

        // A column of the upright image is a vertical plane.
        const glm::dvec3 top = upright.ray(123.5, 0), bottom = upright.ray(123.5, 480);
        EXPECT_NEAR(top.x * bottom.z - top.z * bottom.x, 0, 1e-12);
    }
}

TEST(Rectification, AnUprightCameraStaysAsItIs) {
    const Camera camera = look_at_camera({0, 0.5, 3}, {0, 0.5, 0}, radians(40), 640, 480);
    ASSERT_TRUE(is_upright(camera));
    const Camera upright = upright_camera(camera);
    for (int c = 0; c < 4; ++c) {
        EXPECT_NEAR(glm::distance(glm::dvec3(upright.world_from_camera[c]), glm::dvec3(camera.world_from_camera[c])), 0,
                    1e-12);
    }
}

TEST(Rectification, LooksTheWayTheTopOfTheImagePointsWhenTheCameraLooksStraightDown) {
    Camera camera = look_at_camera({0, 3, 0}, {0, 0, 0}, radians(40), 64, 64);
    const Camera upright = upright_camera(camera);
    EXPECT_LT(rotation_error(upright), 1e-12);
    EXPECT_NEAR(glm::dot(upright.forward(), camera.up()), 1, 1e-9);
}

}  // namespace
}  // namespace rs
