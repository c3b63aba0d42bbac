#include "compositor/viewer/views/object_view.hpp"

#include "compositor/viewer/views/framing.hpp"
#include "engine/core/definition/view_registers.hpp"
#include "tests/compositor/objects.hpp"

#include <gtest/gtest.h>

#include <random>

namespace rs::compositor {
namespace {

Image<Rgba8> engine_image(const PlacedObject& placed, const Camera& camera_in_world) {
    Camera camera = camera_in_node(camera_in_world, placed.world_from_object);
    const RaySpaceObject& object = placed.object->renderer.object();
    camera.world_from_camera[3] = glm::dvec4(camera.centre() * object.units_per_radius, 1);
    const auto registers = engine::prepare_view(object, camera);
    RS_CHECK(registers.ok());
    Image<Rgba8> image(camera.width, camera.height);
    placed.object->renderer.render(*registers, image);
    return image;
}

TEST(ObjectView, ItsRectangleHoldsEverythingThatTheEngineShows) {
    constexpr std::uint64_t kSeed = 11;
    SCOPED_TRACE(kSeed);
    std::mt19937_64 random(kSeed);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto object = test::drum(Rgba8{200, 100, 50, 255});
    int views_with_pixels = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const PlacedObject placed = test::placed_at(
            object, {{number(random), number(random), number(random)}, {0, 1, 0}, number(random) * 3, 0.6});
        const glm::dvec3 eye(number(random) * 6, number(random) * 3, number(random) * 6);
        const glm::dvec3 at(number(random) * 4, number(random), number(random) * 4);
        const Camera camera = look_at_camera(eye, at, radians(70), 120, 90);
        const auto view = view_of_object(placed, camera);
        const Image<Rgba8> whole = engine_image(placed, camera);
        bool shows = false;
        for (int y = 0; y < whole.height(); ++y) {
            for (int x = 0; x < whole.width(); ++x) {
                if (whole(x, y).a == 0) continue;
                shows = true;
                ASSERT_TRUE(view) << trial;
                const ScreenRectangle& r = view->rectangle;
                ASSERT_TRUE(x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height)
                    << "trial " << trial << ", pixel " << x << ", " << y;
            }
        }
        views_with_pixels += shows;
    }
    EXPECT_GT(views_with_pixels, 50);
}

TEST(ObjectView, ItsRectangleIsNotMuchLargerThanTheObject) {
    const PlacedObject placed = test::placed_at(test::drum());
    const Camera camera = look_at_camera({0, 0, 5}, {0, 0, 0}, radians(50), 400, 400);
    const auto view = view_of_object(placed, camera);
    ASSERT_TRUE(view);
    // The drum's near side is at 4 radii: its silhouette is at most 2 / 4 * focal length wide.
    EXPECT_LT(view->rectangle.width, 1.3 * 0.5 * camera.fl_x);
    EXPECT_LT(view->rectangle.height, 1.6 * 0.5 * camera.fl_x);
}

TEST(ObjectView, ItsDepthIsThatOfTheVerticalPlaneFacingTheViewer) {
    const Similarity world_from_object = world_from_node({{{1, 0.5, -2}, {0, 1, 0}, 0.4, 0.7}});
    const PlacedObject placed{test::drum(), world_from_object};
    const Camera camera = look_at_camera({3, 2, 4}, {1, 0.5, -2}, radians(50), 320, 240);
    const auto view = view_of_object(placed, camera);
    ASSERT_TRUE(view);
    const glm::dvec3 axis = world_from_object.translation;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(camera.centre().x - axis.x, 0, camera.centre().z - axis.z));
    for (const glm::dvec2 pixel : {glm::dvec2(0, 0), {319, 10}, {160, 120}, {37.5, 239}}) {
        const glm::dvec3 ray = camera.ray(pixel.x, pixel.y);
        const double depth = glm::dot(normal, axis - camera.centre()) / glm::dot(normal, ray);
        EXPECT_NEAR(glm::dot(view->inverse_depth_facing, glm::dvec3(pixel, 1)), 1 / depth, 1e-12);
    }
    EXPECT_NEAR(view->plane_distance, std::hypot(2.0, 6.0), 1e-9);
}

TEST(ObjectView, BelowItsFootItsDepthIsThatOfTheGroundAndOnTheObjectsSideOfIt) {
    const auto object = test::drum(Rgba8{10, 20, 30, 255});
    const PlacedObject placed = test::placed_at(object, {{1, 0.5, -2}, {0, 1, 0}, 0.4, 2});
    const Camera above = look_at_camera({3, 4, 5}, {1, 0.5, -2}, radians(50), 320, 240);
    const auto view = view_of_object(placed, above);
    ASSERT_TRUE(view);
    const glm::dvec3 pixel(100, 230, 1);
    const double ground = placed.world_from_object.point({0, object->extent.bottom, 0}).y;
    const double depth = (ground - above.centre().y) / above.ray(pixel.x, pixel.y).y;
    // Slightly nearer than the ground, by about a hundredth of the object's radius.
    EXPECT_GT(glm::dot(view->inverse_depth_foot, pixel), 1 / depth);
    EXPECT_LT(glm::dot(view->inverse_depth_foot, pixel), 1.02 / depth);

    EXPECT_TRUE(view->from_above);

    const Camera below = look_at_camera({3, -4, 5}, {1, 0.5, -2}, radians(50), 320, 240);
    const auto from_below = view_of_object(placed, below);
    ASSERT_TRUE(from_below);
    EXPECT_FALSE(from_below->from_above);
    const glm::dvec3 upper(100, 10, 1);
    const double depth_from_below = (ground - below.centre().y) / below.ray(upper.x, upper.y).y;
    EXPECT_LT(glm::dot(from_below->inverse_depth_foot, upper), 1 / depth_from_below);
    EXPECT_GT(glm::dot(from_below->inverse_depth_foot, upper), 0.98 / depth_from_below);
}

// There are no views from above: the nearest elevation is shown, in the same place and continuously.
TEST(ObjectView, FromStraightAboveItIsThatOfTheSteepestElevation) {
    const PlacedObject placed = test::placed_at(test::drum(), {{1, 0.5, -2}, {0, 1, 0}, 0.4, 2});
    const glm::dvec3 middle =
        placed.world_from_object.point({0, 0.5 * (placed.object->bounds.bottom + placed.object->bounds.top), 0});
    const auto view_at = [&](double elevation_deg) {
        const double e = radians(elevation_deg);
        const glm::dvec3 out(0.6 * std::cos(e), std::sin(e), 0.8 * std::cos(e));
        return view_of_object(placed, look_at_camera(middle + 9.0 * out, middle, radians(50), 320, 240));
    };
    for (const double sign : {1.0, -1.0}) {
        const auto steepest = view_at(sign * 60);
        ASSERT_TRUE(steepest);
        for (const double elevation_deg : {60.001, 75.0, 89.0}) {
            const auto view = view_at(sign * elevation_deg);
            ASSERT_TRUE(view) << elevation_deg;
            EXPECT_EQ(view->rectangle, steepest->rectangle) << elevation_deg;
            EXPECT_LT(glm::distance(view->camera.centre(), steepest->camera.centre()), 1e-6) << elevation_deg;
            EXPECT_NEAR(view->plane_distance, steepest->plane_distance, 1e-6) << elevation_deg;
        }
        EXPECT_NE(view_at(sign * 59)->camera.centre(), steepest->camera.centre());
        const auto on_axis =
            view_of_object(placed, look_at_camera(middle + glm::dvec3(0, 9 * sign, 0), middle, radians(50), 320, 240));
        ASSERT_TRUE(on_axis);
        EXPECT_NEAR(on_axis->plane_distance, steepest->plane_distance, 1e-6);
    }
}

TEST(ObjectView, NothingBehindTheCameraBesideTheScreenOrTooSmall) {
    const PlacedObject placed = test::placed_at(test::drum());
    EXPECT_FALSE(view_of_object(placed, look_at_camera({0, 0, 5}, {0, 0, 9}, radians(50), 320, 240)));
    EXPECT_FALSE(view_of_object(placed, look_at_camera({0, 0, 5}, {9, 0, 5}, radians(50), 320, 240)));
    EXPECT_FALSE(view_of_object(placed, look_at_camera({0, 0, 5}, {0, 9, 5}, radians(50), 320, 240)));
    EXPECT_FALSE(view_of_object(placed, look_at_camera({0, 0, 5000}, {0, 0, 0}, radians(50), 320, 240)));
    EXPECT_TRUE(view_of_object(placed, look_at_camera({0, 0, 500}, {0, 0, 0}, radians(50), 320, 240)));
}

TEST(ObjectView, WhatIsDrawnCanBeDrawnHoweverWideTheWindow) {
    const auto object = test::drum();
    int far_aside = 0, drawn = 0;
    for (int angle_deg = -90; angle_deg <= 90; angle_deg += 2) {
        const PlacedObject placed = test::placed_at(
            object, {{5 * std::sin(radians(angle_deg)), 0, -5 * std::cos(radians(angle_deg))}, {0, 1, 0}, 0, 1});
        const Camera camera = look_at_camera({0, 0.5, 0}, {0, 0.4, -1}, radians(178), 3000, 20);
        const auto view = view_of_object(placed, camera);
        far_aside += std::abs(angle_deg) > 84 && !view;
        if (!view) continue;
        ++drawn;
        EXPECT_TRUE(engine::prepare_view(placed.object->renderer.object(), view->camera).ok()) << angle_deg;
    }
    EXPECT_GT(drawn, 10);
    EXPECT_GT(far_aside, 0);
}

TEST(PlacedObject, StandsOnItsFoot) {
    const auto object = test::drum(Rgba8{10, 20, 30, 255});
    // Imaged rows 2 .. 37 of 40, focal length 60, from 3.5 radii; the rim of the foot is 1 radius nearer.
    EXPECT_NEAR(object->extent.bottom, -17 * 2.5 / 60, 0.1);
    EXPECT_NEAR(object->extent.top, 18 * 2.5 / 60, 0.1);
    EXPECT_LT(object->bounds.bottom, object->extent.bottom);
    EXPECT_GT(object->bounds.top, object->extent.top);
    RaySpaceNode node;
    node.chain = {{{3, 1, 0}, {0, 1, 0}, 0, 2}};
    const glm::dvec3 foot = place(object, node).world_from_object.point({0, object->extent.bottom, 0});
    EXPECT_LT(glm::distance(foot, glm::dvec3(3, 1, 0)), 1e-12);
    node.standing = false;
    EXPECT_EQ(place(object, node).world_from_object.translation, glm::dvec3(3, 1, 0));
}

TEST(PlacedObject, StandsWhereItSays) {
    RaySpaceObject standing = test::drum_object(Rgba8{10, 20, 30, 255});
    standing.foot_q20 = -(5 << 18);
    const auto viewable = make_viewable(std::move(standing));
    ASSERT_TRUE(viewable);
    EXPECT_EQ(viewable->extent.bottom, -1.25);
    EXPECT_EQ(viewable->extent.top, test::drum(Rgba8{10, 20, 30, 255})->extent.top);
}

TEST(FramingPose, ShowsAllObjectsWhole) {
    const auto object = test::drum(Rgba8{10, 20, 30, 255});
    const std::vector<PlacedObject> objects = {test::placed_at(object, {{-4, 0, 0}}),
                                               test::placed_at(object, {{5, 1, -3}, {0, 1, 0}, 0, 2})};
    for (const auto& [width, height] : {std::pair{320, 180}, {180, 320}}) {
        const double fov_rad = radians(40);
        const CameraPose pose = framing_pose(objects, fov_rad, static_cast<double>(width) / height);
        const Camera camera = look_at_camera(pose.eye, pose.at, fov_rad, width, height);
        for (const PlacedObject& placed : objects) {
            for (const double y : {object->extent.bottom, object->extent.top}) {
                for (const glm::dvec2 side : {glm::dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
                    const glm::dvec3 pixel =
                        camera.project(placed.world_from_object.point(glm::dvec3(side.x, y, side.y)));
                    EXPECT_GT(pixel.z, 0);
                    EXPECT_TRUE(pixel.x >= 0 && pixel.x <= width && pixel.y >= 0 && pixel.y <= height);
                }
            }
        }
    }
}

}  // namespace
}  // namespace rs::compositor
