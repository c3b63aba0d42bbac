// Navigation: effect of every key and drag.

#include "compositor/viewer/views/navigation.hpp"

#include "rayspace/base/conventions.hpp"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace rs::compositor {
namespace {

constexpr double kNear = 1e-9;

void expect_near(const glm::dvec3& found, const glm::dvec3& expected) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], kNear) << "component " << i;
}

const NavigationSettings kSettings{.speed = 2};

TEST(Walking, KeysMoveAlongTheGroundWhateverThePitch) {
    Visitor visitor;
    visitor.eye = {1, 1.6, 5};
    visitor.pitch_rad = -0.7;
    NavigationInput forward;
    forward.seconds = 0.1;
    forward.forward = 1;
    expect_near(moved(visitor, NavigationMode::kWalk, forward, kSettings).eye, {1, 1.6, 4.8});
    forward.fast = true;
    expect_near(moved(visitor, NavigationMode::kWalk, forward, kSettings).eye, {1, 1.6, 4.2});
    NavigationInput right;
    right.seconds = 0.1;
    right.right = 1;
    expect_near(moved(visitor, NavigationMode::kWalk, right, kSettings).eye, {1.2, 1.6, 5});
    visitor.heading_rad = kPi / 2;  // facing -X; the right is -Z
    expect_near(moved(visitor, NavigationMode::kWalk, right, kSettings).eye, {1, 1.6, 4.8});
}

TEST(Walking, IsNotFasterAcross) {
    NavigationInput both;
    both.seconds = 0.1;
    both.forward = both.right = 1;
    const Visitor next = moved({}, NavigationMode::kWalk, both, kSettings);
    EXPECT_NEAR(glm::length(next.eye), 0.2, kNear);
}

TEST(Walking, AStutterIsNoLeap) {
    NavigationInput slow;
    slow.seconds = 30;
    slow.forward = 1;
    EXPECT_NEAR(glm::length(moved({}, NavigationMode::kWalk, slow, kSettings).eye), 0.5, kNear);
}

TEST(Looking, FollowsTheHand) {
    NavigationInput drag;
    drag.look_px = {-100, -50};  // to the left and up
    const Visitor next = moved({}, NavigationMode::kFly, drag, kSettings);
    EXPECT_NEAR(next.heading_rad, 0.4, kNear);
    EXPECT_NEAR(next.pitch_rad, 0.2, kNear);
    EXPECT_LT(next.sight().x, 0);
    EXPECT_GT(next.sight().y, 0);
    drag.look_px = {0, -1e6};
    EXPECT_NEAR(moved({}, NavigationMode::kWalk, drag, kSettings).pitch_rad, kMaxPitch_rad, kNear);
}

TEST(Flying, GoesWhereOneLooks) {
    Visitor visitor;
    visitor.pitch_rad = 0.5;
    NavigationInput forward;
    forward.seconds = 0.2;
    forward.forward = 1;
    expect_near(moved(visitor, NavigationMode::kFly, forward, kSettings).eye, 0.4 * visitor.sight());
}

TEST(Examining, KeepsThePivotInSight) {
    Visitor visitor;
    visitor.eye = {0, 1, 4};
    visitor.pivot_distance = 4;
    const glm::dvec3 pivot = visitor.pivot();
    NavigationInput drag;
    drag.look_px = {120, -40};
    drag.wheel = 2;
    const Visitor next = moved(visitor, NavigationMode::kExamine, drag, kSettings);
    expect_near(next.pivot(), pivot);
    EXPECT_LT(next.pivot_distance, visitor.pivot_distance);
    EXPECT_GT(next.pivot_distance, 0);
    drag.wheel = 1000;
    EXPECT_GT(moved(visitor, NavigationMode::kExamine, drag, kSettings).pivot_distance, 0);
}

TEST(Panning, MovesTheSceneWithTheHand) {
    NavigationInput pan;
    pan.pan_px = {10, 20};
    const Visitor next = moved({}, NavigationMode::kWalk, pan, kSettings);
    EXPECT_LT(next.eye.x, 0);  // the scene moves to the right
    EXPECT_GT(next.eye.y, 0);  // and down
    EXPECT_EQ(next.eye.z, 0);
}

TEST(Visitors, ComeFromViewpointsAndGiveThemBack) {
    Visitor visitor;
    visitor.eye = {3, 2, 1};
    visitor.heading_rad = 2.1;
    visitor.pitch_rad = -0.4;
    visitor.pivot_distance = 5;
    Viewpoint like;
    like.field_of_view_rad = 0.9;
    const Viewpoint viewpoint = viewpoint_of(visitor, like);
    EXPECT_EQ(viewpoint.field_of_view_rad, 0.9);
    const glm::dmat3 rotation(viewpoint.world_from_camera);
    EXPECT_NEAR(glm::determinant(rotation), 1, kNear);
    const Visitor back = visitor_at(viewpoint, visitor.pivot());
    expect_near(back.eye, visitor.eye);
    EXPECT_NEAR(back.heading_rad, visitor.heading_rad, kNear);
    EXPECT_NEAR(back.pitch_rad, visitor.pitch_rad, kNear);
    EXPECT_NEAR(back.pivot_distance, 5, kNear);
}

// For a viewpoint that looks straight down, forward is towards the upper image edge.
TEST(Visitors, FromAboveKnowWhereForwardIs) {
    Viewpoint above;
    above.world_from_camera =
        glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 9, 0, 1));
    const Visitor visitor = visitor_at(above, {0, 0, 0});
    EXPECT_NEAR(visitor.heading_rad, 0, kNear);
    EXPECT_NEAR(visitor.pitch_rad, -kMaxPitch_rad, kNear);
    EXPECT_NEAR(visitor.pivot_distance, 9, kNear);
}

TEST(Visitors, TurnTheShorterWay) {
    Visitor from;
    from.heading_rad = 3;
    Visitor to = from;
    to.heading_rad = -3;
    to.eye = {2, 0, 0};
    EXPECT_NEAR(std::abs(between(from, to, 0.5).heading_rad), kPi, kNear);
    expect_near(between(from, to, 0.5).eye, {1, 0, 0});
    expect_near(between(from, to, 7).eye, to.eye);
    EXPECT_NEAR(between(from, to, 1).heading_rad, -3, kNear);
}

TEST(Modes, AreThoseOfTheScene) {
    Navigation navigation;
    navigation.types = {"EXAMINE", "ANY"};
    EXPECT_EQ(mode_of(navigation), NavigationMode::kExamine);
    navigation.types = {"NONE", "FLY"};
    EXPECT_EQ(mode_of(navigation), NavigationMode::kFly);
    navigation.types = {};
    EXPECT_EQ(mode_of(navigation), NavigationMode::kWalk);
    EXPECT_STREQ(name_of(NavigationMode::kExamine), "examine");
}

TEST(Navigation, FacesAPoint) {
    Visitor visitor{.eye = {1, 2, 3}};
    for (const glm::dvec3& point : {glm::dvec3(0, 1, 0), {5, 2.5, 4}, {1, 2.1, 9}}) {
        const Visitor turned = facing(visitor, point);
        EXPECT_EQ(turned.eye, visitor.eye);
        EXPECT_NEAR(glm::distance(turned.pivot(), point), 0, kNear);
    }
    EXPECT_EQ(facing(visitor, visitor.eye).heading_rad, visitor.heading_rad);
}

}  // namespace
}  // namespace rs::compositor
