#include "capture/posed/up_axis.hpp"

#include "tests/capture/posed/posed_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rs::capture {
namespace {

using testing::HasSubstr;

std::vector<Camera> cameras_in(const test::PosedWorld& world, int count) {
    std::vector<Camera> cameras;
    for (const PosedCamera& posed : test::posed_cameras(count, 64, 48)) {
        cameras.push_back(posed.camera);
        cameras.back().world_from_camera = world.pose(posed.camera.world_from_camera);
    }
    return cameras;
}

// Turns the camera about its optical axis.
void roll(Camera& camera, double angle_rad) {
    const glm::dvec3 right = camera.right(), up = camera.up();
    camera.world_from_camera[0] = glm::dvec4(std::cos(angle_rad) * right + std::sin(angle_rad) * up, 0);
    camera.world_from_camera[1] = glm::dvec4(std::cos(angle_rad) * up - std::sin(angle_rad) * right, 0);
}

double off_deg(const Result<UpAxis>& up, const glm::dvec3& truth) {
    EXPECT_TRUE(up.ok());
    return degrees(std::acos(glm::clamp(glm::dot(up->direction, truth), -1.0, 1.0)));
}

TEST(UpAxis, IsThatOfLevelCameras) {
    const test::PosedWorld world = test::z_up_world();
    std::vector<Camera> cameras = cameras_in(world, 30);
    EXPECT_LT(off_deg(find_up({}, cameras, world.shift), {0, 0, 1}), 1e-6);
    // Held by hand, and some photos far from level.
    for (std::size_t i = 0; i < cameras.size(); ++i) roll(cameras[i], radians(2 * std::sin(7.0 * double(i))));
    for (std::size_t i = 0; i < 6; ++i) roll(cameras[i], radians(40));
    EXPECT_LT(off_deg(find_up({}, cameras, world.shift), {0, 0, 1}), 1.5);
}

TEST(UpAxis, PhotosStoredOnTheirSide) {
    const test::PosedWorld world = test::z_up_world();
    std::vector<Camera> cameras = cameras_in(world, 30);
    for (std::size_t i = 0; i < cameras.size(); i += 2) roll(cameras[i], radians(90));
    EXPECT_LT(off_deg(find_up({}, cameras, world.shift), {0, 0, 1}), 1e-6) << "portrait and landscape";
    for (std::size_t i = 1; i < cameras.size(); i += 2) roll(cameras[i], radians(90));
    EXPECT_LT(off_deg(find_up({}, cameras, world.shift), {0, 0, 1}), 1e-6) << "all; most cameras are above";
}

TEST(UpAxis, SteepPhotosStoredOnTheirSide) {
    std::vector<Camera> cameras;
    for (int i = 0; i < 24; ++i) {
        const double turn = 2.4 * i, rise = radians(i % 3 == 0 ? 10 : 68);
        const glm::dvec3 eye(std::cos(rise) * std::sin(turn), std::sin(rise), std::cos(rise) * std::cos(turn));
        cameras.push_back(look_at_camera(4.0 * eye, {0, 0, 0}, 1, 64, 48));
        roll(cameras.back(), radians(90));
    }
    EXPECT_LT(off_deg(find_up({}, cameras, {0, 0, 0}), {0, 1, 0}), 1e-6);
}

TEST(UpAxis, OneLevelRingOnItsSide) {
    std::vector<Camera> cameras;
    for (int i = 0; i < 12; ++i) {
        const glm::dvec3 eye(std::sin(i * radians(30)), 0.2, std::cos(i * radians(30)));
        cameras.push_back(look_at_camera(4.0 * eye, {0, 0.8, 0}, 1, 64, 48));
        roll(cameras.back(), radians(90));
    }
    EXPECT_LT(off_deg(find_up({}, cameras, {0, 0, 0}), {0, 1, 0}), 1e-6);
}

TEST(UpAxis, OnRequest) {
    const std::vector<Camera> cameras = cameras_in({}, 12);
    EXPECT_LT(off_deg(find_up(*parse_up("0,0,-2"), cameras, {}), {0, 0, -1}), 1e-9);
    EXPECT_LT(off_deg(find_up(*parse_up("photo"), cameras, {}), {0, 1, 0}), 30);
    EXPECT_EQ(find_up(*parse_up("photo"), cameras, {})->from, "photos");
    for (const char* const wrong : {"", "1,2", "1,2,3,4", "0,0,0", "x,y,z", "1,nan,0", "up"}) {
        EXPECT_FALSE(parse_up(wrong).ok()) << wrong;
    }
}

TEST(UpAxis, WithoutCommonHorizonItIsTheMeanUpWithANote) {
    std::vector<Camera> cameras = cameras_in({}, 20);
    for (std::size_t i = 0; i < cameras.size(); ++i) roll(cameras[i], radians(i % 2 == 0 ? 30 : -40));
    const auto up = find_up({}, cameras, {});
    ASSERT_TRUE(up.ok());
    ASSERT_EQ(up->notes.size(), 1U);
    EXPECT_THAT(up->notes[0], HasSubstr("--up x,y,z"));
}

}  // namespace
}  // namespace rs::capture
