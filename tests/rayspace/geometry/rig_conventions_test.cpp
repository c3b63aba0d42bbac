#include "rayspace/geometry/rig_conventions.hpp"

#include "rayspace/base/conventions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace rs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Rig turn(int count = 24, double first_rad = 0.3) {
    return make_ring({.count = count,
                      .distance = 3.5,
                      .elevation_rad = 0.4,
                      .fl_px = 180,
                      .width = 16,
                      .height = 12,
                      .first_rad = first_rad});
}

// The rig in another frame: rotated, then shifted.
Rig moved(Rig rig, const glm::dquat& rotation, const glm::dvec3& shift, double scale = 1) {
    for (RigView& view : rig.views) {
        const glm::dvec3 centre = rotation * view.camera.centre() * scale + shift;
        view.camera.world_from_camera =
            glm::dmat4(glm::mat3_cast(rotation) * glm::dmat3(view.camera.world_from_camera));
        view.camera.world_from_camera[3] = glm::dvec4(centre, 1);
    }
    return rig;
}

glm::dquat z_up() {
    return glm::angleAxis(kPi / 2, glm::dvec3(1, 0, 0));
}

glm::dquat tilted() {
    return glm::angleAxis(2.1, glm::normalize(glm::dvec3(1, 0.4, -0.7)));
}

double rms_from(const Rig& a, const Rig& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.views.size(); ++i) {
        const glm::dvec3 off = a.views[i].camera.centre() - b.views[i].camera.centre();
        sum += glm::dot(off, off);
    }
    return std::sqrt(sum / static_cast<double>(a.views.size()));
}

// Distance of the cameras from the Y axis, and their height: the same for all of a turn about Y.
void expect_turn_about_y(const Rig& rig, double distance, double tolerance) {
    for (const RigView& view : rig.views) {
        const glm::dvec3 centre = view.camera.centre();
        EXPECT_NEAR(std::hypot(centre.x, centre.z), distance, tolerance);
        EXPECT_NEAR(centre.y, rig.views.front().camera.centre().y, tolerance);
        EXPECT_GT(view.camera.up().y, 0.8);
        EXPECT_LT(rotation_error(view.camera), 1e-9);
    }
}

TEST(RigConventions, ATurnAboutYIsKept) {
    const Rig truth = turn();
    for (const double shift : {0.0, 0.05}) {  // negligible
        Rig rig = moved(truth, glm::dquat(1, 0, 0, 0), {shift, 0, 0});
        const Rig before = rig;
        EXPECT_THAT(apply_rig_conventions(rig), IsEmpty());
        EXPECT_EQ(rms_from(rig, before), 0);
    }
}

TEST(RigConventions, AnAxisBesideTheOriginIsShifted) {
    const Rig truth = turn();
    Rig rig = moved(truth, glm::dquat(1, 0, 0, 0), {7, 0.5, -3});
    EXPECT_THAT(align_turn_axis(rig), HasSubstr("moved to (7, 0, -3)"));
    EXPECT_LT(rms_from(rig, moved(truth, glm::dquat(1, 0, 0, 0), {0, 0.5, 0})), 1e-9) << "heights are kept";
}

TEST(RigConventions, ATiltedAxisBecomesY) {
    const double distance = 3.5 * std::cos(0.4);
    for (const glm::dquat& rotation : {z_up(), tilted(), glm::angleAxis(kPi, glm::dvec3(1, 0, 0))}) {
        Rig rig = moved(turn(), rotation, {70, -30, 20}, 0.01);
        EXPECT_THAT(align_turn_axis(rig), HasSubstr("becomes Y"));
        expect_turn_about_y(rig, 0.01 * distance, 1e-9);
        EXPECT_NEAR(rig.views.front().camera.centre().y, 0.035 * std::sin(0.4), 1e-6) << "the cameras look at Y = 0";
    }
    Rig rig = moved(turn(), z_up(), {0, 0, 1});
    align_turn_axis(rig);
    EXPECT_NEAR(rig.views.front().camera.centre().y, 1 + 3.5 * std::sin(0.4), 1e-9) << "Z is the height";
}

TEST(RigConventions, HalfATurnWithNoise) {
    Rig rig = turn(40);
    rig.views.resize(20);
    rig = moved(rig, tilted(), {1, 2, 3});
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.003);
    for (RigView& view : rig.views) {
        const glm::dquat shake = glm::normalize(glm::dquat(1, noise(random), noise(random), noise(random)));
        const glm::dvec3 centre = view.camera.centre() + glm::dvec3(noise(random), noise(random), noise(random));
        view.camera.world_from_camera = glm::dmat4(glm::mat3_cast(shake) * glm::dmat3(view.camera.world_from_camera));
        view.camera.world_from_camera[3] = glm::dvec4(centre, 1);
    }
    EXPECT_THAT(align_turn_axis(rig), HasSubstr("becomes Y"));
    expect_turn_about_y(rig, 3.5 * std::cos(0.4), 0.05);
}

TEST(RigConventions, OpencvAxesOfAnotherFrame) {
    const Rig truth = turn();
    Rig rig = moved(truth, z_up(), {10, 0, 0});
    for (RigView& view : rig.views) {
        for (const int column : {1, 2}) view.camera.world_from_camera[column] *= -1;
    }
    EXPECT_THAT(apply_rig_conventions(rig), ElementsAre(HasSubstr("becomes Y"), HasSubstr("OpenCV")));
    expect_turn_about_y(rig, 3.5 * std::cos(0.4), 1e-9);
    for (const RigView& view : rig.views) EXPECT_LT(view.camera.forward().y, 0) << "the cameras look down";
}

TEST(RigConventions, PhotosOnTheirSide) {
    Rig rig = moved(turn(), z_up(), {10, 0, 0});
    for (RigView& view : rig.views) {
        glm::dmat4& m = view.camera.world_from_camera;
        const glm::dvec4 right = m[0];
        m[0] = m[1];
        m[1] = -right;
    }
    EXPECT_THAT(align_turn_axis(rig), HasSubstr("(0, 0, 1) becomes Y"));
}

TEST(RigConventions, OtherCamerasAreNoTurn) {
    const auto is_turn = [](const Rig& rig) { return find_turn_axis(moved(rig, tilted(), {5, 0, 0})).has_value(); };
    EXPECT_TRUE(is_turn(turn()));
    EXPECT_FALSE(is_turn(turn(4)));
    Rig narrow = turn(24);
    narrow.views.resize(5);
    EXPECT_FALSE(is_turn(narrow)) << "60 degrees";
    Rig rings = turn();
    for (RigView& view : make_ring({.count = 24, .distance = 3.5, .elevation_rad = 0.8, .fl_px = 180}).views) {
        rings.views.push_back(view);
    }
    EXPECT_FALSE(is_turn(rings));
    Rig panorama = turn();
    for (RigView& view : panorama.views) view.camera.world_from_camera[3] = {0, 0, 0, 1};
    EXPECT_FALSE(is_turn(panorama));
    Rig grid = turn();
    for (RigView& view : grid.views) view.camera.world_from_camera = glm::dmat4(1);
    EXPECT_FALSE(is_turn(grid)) << "one attitude";
    Rig outlier = turn();
    outlier.views[3].camera.world_from_camera[3].y += 0.5;
    EXPECT_FALSE(is_turn(outlier));
}

TEST(RigConventions, RigsThatReferToTheirYAxisAreKept) {
    const auto aligned = [](const auto& change) {
        Rig rig = moved(turn(), z_up(), {5, 0, 0});
        change(rig);
        return align_turn_axis(rig);
    };
    EXPECT_THAT(aligned([](Rig&) {}), HasSubstr("becomes Y"));
    EXPECT_THAT(aligned([](Rig& rig) { rig.object_radius = 1; }), IsEmpty());
    EXPECT_THAT(aligned([](Rig& rig) { rig.foot_height = 0; }), IsEmpty());
    EXPECT_THAT(aligned([](Rig& rig) { rig.extras[kPosedKey] = true; }), IsEmpty());
    EXPECT_THAT(aligned([](Rig& rig) { rig.extras[kPosedKey] = false; }), HasSubstr("becomes Y"));
}

TEST(RigConventions, CamerasWithOpencvAxesAreConverted) {
    Rig rig = turn(6);
    EXPECT_FALSE(convert_opencv_axes(rig));
    const Rig truth = rig;
    for (RigView& view : rig.views) {
        for (const int column : {1, 2}) view.camera.world_from_camera[column] *= -1;
    }
    EXPECT_TRUE(convert_opencv_axes(rig));
    for (std::size_t i = 0; i < rig.views.size(); ++i) {
        EXPECT_EQ(rig.views[i].camera.world_from_camera, truth.views[i].camera.world_from_camera);
    }
}

}  // namespace
}  // namespace rs
