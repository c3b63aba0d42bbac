// Scenes made of object files.

#include "compositor/viewer/views/object_scene.hpp"

#include "rayspace/format/object_file.hpp"
#include "tests/support/small_object.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace rs::compositor {
namespace {

class ObjectScene : public ::testing::Test {
protected:
    // Cameras at height 0 and distance 3.5, 0.5 above the ground, in radii.
    std::string object(const std::string& name, double radius) const {
        RaySpaceObject small = test::small_object();
        small.units_per_radius = radius;
        small.foot_q20 = -(1 << 19);
        EXPECT_TRUE(write_object(work_ / name, small));
        return (work_ / name).string();
    }
    test::TemporaryFolder work_;
};

TEST_F(ObjectScene, HasTheObjectsSizeAndItsCamerasDistanceAndHeight) {
    const Result<Scene> scene = scene_of_objects({object("a.rso", 2.5)});
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    ASSERT_EQ(scene->objects.size(), 1U);
    const Similarity placed = world_from_node(scene->objects[0].chain);
    EXPECT_EQ(placed.scale, 2.5);
    EXPECT_EQ(placed.translation, glm::dvec3(0));
    EXPECT_TRUE(scene->objects[0].standing);
    EXPECT_TRUE(scene->objects[0].required);
    ASSERT_EQ(scene->viewpoints.size(), 1U);
    const glm::dvec3 eye(scene->viewpoints[0].world_from_camera[3]);
    EXPECT_NEAR(eye.x, 0, 1e-6);
    EXPECT_NEAR(eye.y, 2.5 * 0.5, 1e-4);
    EXPECT_NEAR(eye.z, 2.5 * 3.5, 1e-4);
    EXPECT_EQ(scene->navigation.types.front(), "EXAMINE");
    ASSERT_TRUE(scene->floor.has_value());
    EXPECT_EQ(scene->floor->colour_a, scene->floor->colour_b);
    EXPECT_EQ(scene->floor->height, 0);
}

TEST_F(ObjectScene, StandsSeveralBesideEachOtherWithoutOverlap) {
    const Result<Scene> scene = scene_of_objects({object("a.rso", 2), object("b.rso", 0.5), object("c.rso", 1)});
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    double end = -1e9;
    double sum = 0;
    for (const RaySpaceNode& node : scene->objects) {
        const Similarity placed = world_from_node(node.chain);
        EXPECT_GE(placed.translation.x - placed.scale, end);
        end = placed.translation.x + placed.scale;
        sum += placed.scale;
        EXPECT_LT(end, 6);
    }
    EXPECT_EQ(sum, 3.5);
    EXPECT_TRUE(scene->viewpoints.empty());  // the row is framed
}

TEST_F(ObjectScene, ScalesExtremeSizesAlike) {
    const Result<Scene> scene = scene_of_objects({object("a.rso", 4000), object("b.rso", 1000)});
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_DOUBLE_EQ(scene->objects[0].chain[0].scale, 1);
    EXPECT_DOUBLE_EQ(scene->objects[1].chain[0].scale, 0.25);
}

TEST_F(ObjectScene, NamesAFileThatIsNone) {
    const std::string garbage = (work_ / "garbage.rso").string();
    std::ofstream(garbage) << "garbage";
    const Result<Scene> scene = scene_of_objects({object("a.rso", 1), garbage});
    ASSERT_FALSE(scene.ok());
    EXPECT_THAT(scene.error().message, ::testing::HasSubstr("garbage.rso"));
}

}  // namespace
}  // namespace rs::compositor
