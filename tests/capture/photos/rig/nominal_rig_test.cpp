#include "capture/photos/rig/nominal_rig.hpp"

#include "rayspace/base/conventions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rs::capture {
namespace {

// Silhouette of a ball whose centre circles the axis at `orbit` (heights from `bottom`), projected by the camera of
// `rig`.
Image<Rgba8> silhouette(const Camera& camera, const glm::dvec3& centre, double radius) {
    Image<Rgba8> image(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            const glm::dvec3 ray = glm::normalize(camera.ray(x + 0.5, y + 0.5));
            const glm::dvec3 to_ball = centre - camera.centre();
            const double miss = glm::length(to_ball - ray * glm::dot(ray, to_ball));
            if (miss <= radius) image(x, y) = {255, 255, 255, 255};
        }
    }
    return image;
}

// Also for a camera that looks down: the axis is still vertical in the image.
TEST(TurnSilhouette, FindsTheAxisOfATurnInPerspective) {
    for (const double elevation_deg : {0.0, 20.0}) {
        Camera camera = look_at_camera({0, 6 * std::tan(radians(elevation_deg)), 6}, {0, 0, 0}, radians(30), 320, 240);
        camera.cx = 171.5;  // the axis' column
        TurnSilhouette silhouette_sum(320, 240);
        TurnSilhouette second(320, 240);
        for (int i = 0; i < 36; ++i) {
            const double angle = 2 * kPi * i / 36 + 0.05;
            const glm::dvec3 centre(0.6 * std::sin(angle), 0.1, 0.6 * std::cos(angle));
            (i % 2 == 0 ? silhouette_sum : second).add(silhouette(camera, centre, 0.4));
        }
        silhouette_sum.merge(second);
        const auto axis = silhouette_sum.axis();
        ASSERT_TRUE(axis.has_value());
        EXPECT_NEAR(axis->x_px, 171.5, 1.0) << elevation_deg;
        EXPECT_LE(axis->spread_px, 1.0);
    }
}

TEST(TurnSilhouette, GivesNoAxisWhereItCannot) {
    TurnSilhouette silhouette_sum(50, 40);
    EXPECT_FALSE(silhouette_sum.axis().has_value());
    EXPECT_TRUE(silhouette_sum.visible().empty());
    silhouette_sum.add(Image<Rgba8>(50, 40, Rgba8{1, 1, 1, 255}));  // every row reaches both sides
    EXPECT_FALSE(silhouette_sum.axis().has_value());
    EXPECT_EQ(silhouette_sum.visible().right, 50);
}

TEST(NominalRig, TheOutermostRayTouchesTheUnitCircle) {
    for (const double extent_px : {1.0, 80.0, 200.0, 900.0}) {
        const double fl_px = 640;
        const double distance = distance_for_unit_radius(extent_px, fl_px);
        // Distance of the axis from the ray through `extent_px`: d sin(theta).
        EXPECT_NEAR(distance * std::sin(std::atan(extent_px / fl_px)), 1, 1e-12);
    }
}

TEST(NominalRig, SeesTheObjectWhereTheImagesShowIt) {
    NominalRigOptions options;
    options.width = 640;
    options.height = 480;
    options.views = 24;
    options.step_deg = 15;
    options.axis_x_px = 333;
    TurnSilhouette::Box visible;
    visible.left = 100;
    visible.right = 500;
    visible.top = 60;
    visible.bottom = 400;
    const Rig rig = make_nominal_rig(options, visible);
    ASSERT_EQ(rig.views.size(), 24U);
    EXPECT_EQ(rig.object_radius, 1);
    for (const RigView& view : rig.views) {
        EXPECT_LT(rotation_error(view.camera), 1e-12);
        EXPECT_TRUE(is_upright(view.camera));
        const glm::dvec3 on_axis = view.camera.project({0, 0.3, 0});
        EXPECT_NEAR(on_axis.x, 333, 1e-9);
        EXPECT_NEAR(view.camera.project({0, 0, 0}).y, 230, 1e-9);
        // The wider side is the left one: 233 px. The circle's tangent point in the image of this camera:
        const double distance = glm::length(view.camera.centre());
        const glm::dvec3 towards = -view.camera.forward();
        const glm::dvec3 tangent = towards / distance - view.camera.right() * std::sqrt(1 - 1 / (distance * distance));
        EXPECT_NEAR(view.camera.project(tangent).x, 100, 1e-9);
    }
}

TEST(NominalRig, TurnsAsMakeRingDoesUnlessCounterClockwise) {
    NominalRigOptions options;
    options.width = options.height = 64;
    options.views = 8;
    options.step_deg = 45;
    options.axis_x_px = 32;
    const TurnSilhouette::Box visible{10, 54, 10, 54};
    const Rig clockwise = make_nominal_rig(options, visible);
    options.turning = Turning::kCounterClockwise;
    const Rig counter = make_nominal_rig(options, visible);
    RingOptions ring_options;
    ring_options.count = 8;
    ring_options.distance = glm::length(clockwise.views[0].camera.centre());
    ring_options.width = ring_options.height = 64;
    ring_options.fl_px = clockwise.views[0].camera.fl_x;
    const Rig ring = make_ring(ring_options);
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::dvec3 expected = ring.views[i].camera.centre();
        EXPECT_LT(glm::length(clockwise.views[i].camera.centre() - expected), 1e-9) << i;
        EXPECT_LT(glm::length(counter.views[i].camera.centre() - glm::dvec3(-expected.x, expected.y, expected.z)), 1e-9)
            << i;
    }
}

}  // namespace
}  // namespace rs::capture
