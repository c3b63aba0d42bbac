// Projection of walls as windows.

#include "compositor/displays/wall.hpp"

#include "compositor/displays/walls_file.hpp"
#include "rayspace/base/conventions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace rs::compositor {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kEyes_m = 0.065;
const RoomPose kPlace{.position = {3, -0.4, 17}, .heading_rad = 0.7, .units_per_metre = 1.3};

Wall front_wall() {
    return {"front", {-1.5, 0, -1.5}, {1.5, 0, -1.5}, {-1.5, 3, -1.5}, 1024, 768};
}

Camera camera_of(const Wall& wall, const glm::dvec3& eye, const RoomPose& place = kPlace) {
    const auto camera = wall_camera(wall, eye, place);
    EXPECT_TRUE(camera.ok()) << camera.error().message;
    return *camera;
}

TEST(Wall, ItsCornersAreTheImagesCorners) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> number(-1.2, 1.2);
    for (int i = 0; i < 100; ++i) {
        const Wall wall = front_wall();
        const glm::dvec3 eye(number(random), 1.5 + number(random), number(random));
        const Camera camera = camera_of(wall, eye);
        const auto expect_at = [&](const glm::dvec3& corner, double x, double y) {
            const glm::dvec3 p = camera.project(kPlace.in_scene(corner));
            EXPECT_NEAR(p.x, x, 1e-9);
            EXPECT_NEAR(p.y, y, 1e-9);
        };
        expect_at(wall.lower_left, 0, 768);
        expect_at(wall.lower_right, 1024, 768);
        expect_at(wall.upper_left, 0, 0);
        EXPECT_LT(rotation_error(camera), 1e-12);
    }
}

// Adjacent walls show a point behind their common edge at the same height of the edge.
TEST(Wall, TwoWallsMeetAtTheirSeam) {
    const WallDisplay cave = *preset_display("cave");
    const auto wall = [&](const char* name) {
        return *std::find_if(cave.walls.begin(), cave.walls.end(), [&](const Wall& w) { return w.name == name; });
    };
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> number(-1.2, 1.2);
    for (int i = 0; i < 1000; ++i) {
        Head head;
        head.position = {number(random), 1.5 + number(random), number(random)};
        head.heading_rad = 3 * number(random);
        head.roll_rad = number(random);
        const glm::dvec3 eye = head.eye(i % 2 == 0 ? kEyes_m / 2 : -kEyes_m / 2);
        const Camera left = camera_of(wall("left"), eye);
        const Camera ahead = camera_of(wall("front"), eye);
        const Camera floor = camera_of(wall("floor"), eye);
        const double along = (number(random) + 1.2) / 2.4;
        const double beyond = 1 + 20 * std::abs(number(random));  // distance behind the wall
        const auto seen = [&](const glm::dvec3& on_wall) { return kPlace.in_scene(eye + beyond * (on_wall - eye)); };

        const glm::dvec3 upright = seen({-1.5, 3 * along, -1.5});
        EXPECT_NEAR(left.project(upright).x, 1024, 1e-9);
        EXPECT_NEAR(ahead.project(upright).x, 0, 1e-9);
        EXPECT_NEAR(left.project(upright).y, ahead.project(upright).y, 1e-9);
        const glm::dvec3 level = seen({-1.5 + 3 * along, 0, -1.5});
        EXPECT_NEAR(ahead.project(level).y, 1024, 1e-9);
        EXPECT_NEAR(floor.project(level).y, 0, 1e-9);
        EXPECT_NEAR(floor.project(level).x, ahead.project(level).x, 1e-9);
    }
}

// Parallax on a wall at distance d of a point at distance z from the eyes: e (1 - d/z).
TEST(Wall, BothEyesSeeAPointWhereTheFormulaSays) {
    const Wall wall = front_wall();
    const Head head{.position = {0.3, 1.6, 0.2}};
    const double d = 1.7;
    const double px_per_m = 1024 / 3.0;
    for (const double z : {0.5, 1.0, 1.7, 2.5, 10.0, 1e4}) {
        const glm::dvec3 point = kPlace.in_scene(head.position + glm::dvec3(0.2, -0.3, -z));
        const glm::dvec3 left = camera_of(wall, head.eye(-kEyes_m / 2)).project(point);
        const glm::dvec3 right = camera_of(wall, head.eye(kEyes_m / 2)).project(point);
        EXPECT_NEAR(right.x - left.x, kEyes_m * (1 - d / z) * px_per_m, 1e-6) << z;
        EXPECT_NEAR(right.y, left.y, 1e-9);
        EXPECT_NEAR(left.z, z * kPlace.units_per_metre, 1e-9);
    }
}

TEST(Wall, AHeadsRightFollowsItsTurns) {
    const auto expect_right = [](const Head& head, const glm::dvec3& right) {
        EXPECT_LT(glm::distance(head.right(), right), 1e-12);
    };
    expect_right({}, {1, 0, 0});
    expect_right({.heading_rad = kPi / 2}, {0, 0, -1});
    expect_right({.pitch_rad = 1}, {1, 0, 0});
    expect_right({.roll_rad = kPi / 2}, {0, -1, 0});
    expect_right({.pitch_rad = kPi / 2, .roll_rad = kPi / 2}, {0, 0, -1});
}

TEST(Wall, UprightWallsHaveUprightCamerasWhereverTheRoomIs) {
    const WallDisplay cave = *preset_display("cave");
    for (const Wall& wall : cave.walls) {
        EXPECT_EQ(is_upright(camera_of(wall, {0.4, 1.9, -0.3})), wall.name != "floor") << wall.name;
    }
}

TEST(Wall, AnEyeBehindAWallOrInItIsRefused) {
    const auto fault = [](const glm::dvec3& eye) {
        const auto camera = wall_camera(front_wall(), eye, kPlace);
        return camera ? std::string() : camera.error().message;
    };
    EXPECT_EQ(fault({0, 1, -1.49}), "");
    EXPECT_THAT(fault({0, 1, -1.5}), AllOf(HasSubstr("'front'"), HasSubstr("in the plane")));
    EXPECT_THAT(fault({0, 1, -1.5005}), HasSubstr("in the plane"));
    EXPECT_THAT(fault({0, 1, -2}), AllOf(HasSubstr("'front'"), HasSubstr("0.5 m behind")));
}

TEST(Wall, CornersMustMakeARectangle) {
    Wall wall = front_wall();
    EXPECT_TRUE(check_wall(wall).ok());
    wall.upper_left.x += 0.01;
    EXPECT_THAT(check_wall(wall).error().message, AllOf(HasSubstr("'front'"), HasSubstr("right angle")));
    wall.upper_left = wall.lower_left;
    EXPECT_THAT(check_wall(wall).error().message, HasSubstr("1 mm"));
}

// The room is placed at the camera: straight ahead in the room is ahead in the scene.
TEST(Wall, TheRoomStandsAroundTheVisitor) {
    const Head head{.position = {0.2, 1.7, 0.5}, .heading_rad = 0.3};
    const Camera visitor = look_at_camera({4, 2, -1}, {-3, 1, 5}, 1, 64, 48);
    const RoomPose place = place_of(visitor, head, 2);
    EXPECT_LT(glm::distance(place.in_scene(head.position), visitor.centre()), 1e-12);
    const glm::dvec3 ahead = place.turned({-std::sin(0.3), 0, -std::cos(0.3)});
    const glm::dvec3 level = glm::normalize(visitor.forward() * glm::dvec3(1, 0, 1));
    EXPECT_LT(glm::distance(ahead, level), 1e-12);
    EXPECT_NEAR(glm::distance(place.in_scene({1, 0, 0}), place.in_scene({0, 0, 0})), 2, 1e-12);
}

TEST(Wall, ASceneIsPutOnTheTable) {
    const Wall table = preset_display("tabletop")->walls.front();
    BoundingBox box;
    box.lowest = {-5, 1, -2};
    box.highest = {11, 9, 6};
    const RoomPose place = fit_scene_to_wall(table, box);
    // The centre of the table is the centre of the box's bottom side.
    EXPECT_LT(glm::distance(place.in_scene({0, table.lower_left.y, 0}), glm::dvec3(3, 1, 2)), 1e-9);
    EXPECT_NEAR(place.units_per_metre, 16 / (0.8 * 0.8), 1e-9);
}

}  // namespace
}  // namespace rs::compositor
