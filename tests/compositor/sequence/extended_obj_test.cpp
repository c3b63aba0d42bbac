#include "compositor/sequence/extended_obj.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <random>

namespace rs::compositor {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Basic example of the format, with texture indices but no texture coordinates.
constexpr const char* kCube = R"(mtllib res1.mtl
o Cube
v 2.448335 2.024842 -5.542307
v 2.448335 0.024842 -5.542307
v 2.448335 2.024842 -3.542307
v 2.448335 0.024842 -3.542307
v 0.448335 2.024842 -5.542307
v 0.448335 0.024842 -5.542307
v 0.448335 2.024842 -3.542307
v 0.448335 0.024842 -3.542307
vn 0.0000 1.0000 0.0000
vn 0.0000 0.0000 1.0000
usemtl Material
s off
f 1/1/1 5/2/1 7/3/1 3/4/1
f 4/5/2 3/4/2 7/6/2 8/7/2
)";

Result<ExtendedObj> parse(const std::string& more) {
    return parse_extended_obj(kCube + more, "scene.obj");
}

TEST(ExtendedObj, InstancesAndCameraOfTheSimpleExampleAreRead) {
    const auto read = parse("instance 0 1.5f 2.5f -4.3f 0 1 0 1 1 1 0\ncamera 15 4 0 0 1 0 90\n");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->objects.size(), 1U);
    EXPECT_EQ(read->objects[0].name, "Cube");
    ASSERT_EQ(read->instances.size(), 1U);
    EXPECT_EQ(read->instances[0].line, 17);
    EXPECT_EQ(read->instances[0].pose.move, glm::dvec3(1.5, 2.5, -4.3));
    EXPECT_EQ(read->instances[0].pose.turn_deg, glm::dvec3(0, 1, 0));
    ASSERT_TRUE(read->camera);
    EXPECT_EQ(read->camera->pose.eye, glm::dvec3(15, 4, 0));
    EXPECT_NEAR(read->camera->fov_x_rad, kPi / 2, 1e-15);
}

TEST(ExtendedObj, DamagedLinesAreRefusedWithFileAndLine) {
    const std::pair<const char*, const char*> damaged[] = {
        {"instance 0 1 2 3 0 0 0 1 1 1", "11 values, not 10"},
        {"instance 0 1 2 3 0 0 0 1 1 1 0 0", "11 values, not 12"},
        {"instance 0 1 2 three 0 0 0 1 1 1 0", "'three' is not a number"},
        {"instance 0 1 2 3 0 0 0 1 0 1 0", "is 0; give a non-zero scale"},
        {"instance 0 1 2 nan 0 0 0 1 1 1 0", "not a number"},
        {"instance 0 1 2 inf 0 0 0 1 1 1 0", "not a number"},
        {"instance 0 1 2 3ff 0 0 0 1 1 1 0", "not a number"},
        {"instance 0 1 2 1e9 0 0 0 1 1 1 0", "out of range"},
        {"instnace 0 1 2 3 0 0 0 1 1 1 0", "is not a statement"},
        {"camera 0 0 0 1 1 1", "7 values"},
        {"camera 0 0 0 0 0 0 60", "same"},
        {"camera 0 0 0 1 1 1 0", "out of range"},
        {"camera 0 0 0 1 1 1 170", "out of range"},
        {"v 1 2", "numbers"},
        {"v 1 2 x", "not a number"},
        {"v 1.0f 2 3", "not a number"},
        {"vn 1 2 3 4", "numbers"},
        {"f 1 2", "corners"},
        {"f 1 2 9", "exceeds the 8 vertices"},
        {"f 1 2 -9", "exceeds the 8 vertices"},
        {"f 1//1 2//1 3//3", "exceeds the 2 normals"},
        {"f 1 2 0", "not an index"},
        {"f 1 2 3/", "not an index"},
        {"f 1 2 3/1/1/1", "too many parts"},
        {"usemtl", "no name"},
        {"o", "no name"},
    };
    for (const auto& [line, what] : damaged) {
        SCOPED_TRACE(line);
        const auto read = parse(std::string("# a comment\n") + line + "\n");
        if (std::string(line) == "f 1 2 3/") {  // an empty part is allowed
            EXPECT_TRUE(read);
            continue;
        }
        ASSERT_FALSE(read);
        EXPECT_THAT(read.error().message, StartsWith("scene.obj:18: "));
        EXPECT_THAT(read.error().message, HasSubstr(what));
        EXPECT_THAT(read.error().message, HasSubstr("; "));
        EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
    }
    const auto twice = parse("camera 0 0 0 1 1 1 60\ncamera 0 0 0 1 1 1 60\n");
    ASSERT_FALSE(twice);
    EXPECT_THAT(twice.error().message, StartsWith("scene.obj:18: there are two cameras"));
}

TEST(ExtendedObj, GroupsBelongToTheObjectBeforeThem) {
    const auto read = parse("g front side\nf 1 2 3\no Other\nf 1 2 3\n");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->objects.size(), 2U);
    EXPECT_THAT(read->objects[0].nodes, ElementsAre("Cube", "front side"));
    EXPECT_THAT(read->objects[1].nodes, ElementsAre("Other"));
}

TEST(ExtendedObj, AddedLinesDoNotChangeTheMesh) {
    const auto plain = parse("");
    const auto moved = parse("instance 0 1 2 3 0 0 0 1 1 1 0\ncamera 0 0 0 1 1 1 60\n");
    const auto other = parse("v 0 0 0\n");
    ASSERT_TRUE(plain && moved && other);
    EXPECT_EQ(plain->mesh_digest, moved->mesh_digest);
    EXPECT_NE(plain->mesh_digest, other->mesh_digest);
}

TEST(ExtendedObj, LinesMayGoOnBehindABackslash) {
    const auto read = parse("instance 0 1 2 3 \\\n 0 0 0 1 1 1 \\\n 0\nf 1 2 99\n");
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message, StartsWith("scene.obj:20: "));
}

// Against glm: from the centre, scale, rotations, translation.
TEST(ExtendedObj, MatricesScaleThenTurnThenMoveAboutTheMiddle) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-50, 50);
    for (int trial = 0; trial < 200; ++trial) {
        const auto any = [&] { return glm::dvec3(number(random), number(random), number(random)); };
        InstancePose pose{any(), 7.2 * any(), any() / 20.0};
        const glm::dvec3 middle = any();
        glm::dmat4 expected = glm::translate(glm::dmat4(1.0), pose.move);
        expected = glm::rotate(expected, glm::radians(pose.turn_deg.z), {0, 0, 1});
        expected = glm::rotate(expected, glm::radians(pose.turn_deg.y), {0, 1, 0});
        expected = glm::rotate(expected, glm::radians(pose.turn_deg.x), {1, 0, 0});
        expected = glm::scale(expected, pose.scale);
        expected = glm::translate(expected, -middle);
        const glm::dmat4 matrix = instance_matrix(pose, middle);
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) EXPECT_NEAR(matrix[column][row], expected[column][row], 1e-6);
        }
    }
    // A quarter turn about X, then about Y: Z goes to -Y, which stays; X goes to -Z.
    const glm::dmat3 turned = turn_matrix({90, 90, 0});
    EXPECT_LT(glm::distance(turned * glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0)), 1e-12);
    EXPECT_LT(glm::distance(turned * glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -1)), 1e-12);
}

}  // namespace
}  // namespace rs::compositor
