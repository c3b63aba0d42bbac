#include "compositor/scene/reader/scene_file.hpp"

#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace rs::compositor {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string scene_error(const std::string& text) {
    const Result<Scene> scene = scene_from_json(text, "rooms/hall.json");
    return scene ? "no error" : scene.error().message;
}

TEST(SceneFile, RoomsHaveTheirObjectsAndBoxes) {
    const Result<Scene> scene = scene_from_json(R"({"nodes": [
        {"room": [{"object": "a.rso", "translate": [1, 0, 0]}, {"group": [{"object": "b.rso"}]}],
         "description": "hall", "bounds": {"centre": [0, 1, 0], "size": [4, 2, 4]}, "translate": [5, 0, 0]},
        {"room": [{"box": [2, 2, 2]}, {"object": "c.rso", "translate": [0, 4, 0]}]},
        {"object": "d.rso"}]})",
                                                "rooms/hall.json");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->rooms.size(), 2U);
    EXPECT_EQ(scene->rooms[0].description, "hall");
    EXPECT_EQ(scene->rooms[0].box.lowest, glm::dvec3(3, 0, -2));
    EXPECT_EQ(scene->rooms[0].box.highest, glm::dvec3(7, 2, 2));
    EXPECT_EQ(scene->rooms[1].box.highest, glm::dvec3(1, 5, 1)) << "of what it holds";
    ASSERT_EQ(scene->objects.size(), 4U);
    EXPECT_EQ(scene->objects[0].room, 0U);
    EXPECT_EQ(scene->objects[1].room, 0U);
    EXPECT_EQ(scene->objects[2].room, 1U);
    EXPECT_FALSE(scene->objects[3].room);
    EXPECT_THAT(scene_error(R"({"nodes": [{"room": [], "bounds": {"centre": [0, 0, 0], "size": [1, 0, 1]}}]})"),
                HasSubstr("nodes[0].bounds.size"));
}

TEST(SceneFile, ReadsEveryKey) {
    const Result<Scene> scene = scene_from_json(R"({
        "background": [1, 1, 1],
        "floor": {"height": -1, "radius": 20, "square": 0.5, "colours": [[0, 0, 0], [1, 1, 1]]},
        "lights": {"towards": [0, -1, 0], "directional": [2, 2, 2], "ambient": [0.1, 0.2, 0.3]},
        "nodes": [
            {"object": "vase.rso", "translate": [1, 2, 3], "rotate": {"degrees": 90}, "scale": 0.5, "standing": false},
            {"group": [{"box": [1, 2, 3], "colour": [0, 1, 0], "scale": 3}], "rotate": {"axis": [1, 0, 0], "degrees": 180}}
        ],
        "camera": {"path": [{"eye": [0, 1, 5], "at": [0, 0, 0]}, {"eye": [5, 1, 0], "at": [0, 0, 0]}],
                   "frames": 30, "closed": true, "fov_degrees": 40}
    })",
                                                "rooms/hall.json");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->background.sky.size(), 1U);
    EXPECT_EQ(scene->background.sky[0], glm::vec3(1));
    ASSERT_TRUE(scene->floor);
    EXPECT_EQ(scene->floor->height, -1);
    EXPECT_EQ(scene->floor->radius, 20);
    EXPECT_EQ(scene->floor->square, 0.5);
    EXPECT_EQ(scene->floor->colour_b, glm::vec3(1));
    ASSERT_EQ(scene->lights.size(), 1U);
    EXPECT_EQ(scene->lights[0].towards, glm::dvec3(0, -1, 0));
    EXPECT_EQ(scene->lights[0].colour, glm::vec3(2));
    EXPECT_EQ(scene->lights[0].ambient.z, 0.3F);
    EXPECT_FALSE(scene->navigation.headlight);
    ASSERT_EQ(scene->objects.size(), 1U);
    EXPECT_EQ(scene->objects[0].file, "rooms/vase.rso");
    EXPECT_FALSE(scene->objects[0].standing);
    ASSERT_EQ(scene->objects[0].chain.size(), 1U);
    EXPECT_LT(glm::distance(world_from_node(scene->objects[0].chain).point({0, 0, 2}), glm::dvec3(2, 2, 3)), 1e-12);
    ASSERT_EQ(scene->geometry.size(), 1U);
    const glm::dvec3 above(scene->geometry[0].world_from_node * glm::dvec4(0, 1, 0, 1));
    EXPECT_LT(glm::distance(above, glm::dvec3(0, -3, 0)), 1e-12);
    EXPECT_EQ(scene->geometry[0].material.diffuse, glm::vec3(0, 1, 0));
    ASSERT_TRUE(scene->camera);
    EXPECT_EQ(scene->camera->keys.size(), 2U);
    EXPECT_EQ(scene->camera->frames, 30);
    EXPECT_TRUE(scene->camera->closed);
}

TEST(SceneFile, TheExampleOfTheReadmeIsRead) {
    std::ifstream file(std::filesystem::path(RAYSPACE_SOURCE_DIR) / "compositor/README.md");
    const std::string readme((std::istreambuf_iterator<char>(file)), {});
    const std::size_t begin = readme.find("```json\n");
    ASSERT_NE(begin, std::string::npos);
    const std::string example = readme.substr(begin + 8, readme.find("```", begin + 8) - begin - 8);
    const Result<Scene> scene = scene_from_json(example, "README.md");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->objects.size(), 2U);
    EXPECT_EQ(scene->geometry.size(), 2U);
    // Default values are used where possible.
    const Scene defaults;
    EXPECT_LT(glm::distance(scene->background.sky[0], defaults.background.sky[0]), 0.02F);
    EXPECT_LT(glm::distance(scene->floor->colour_a, Floor{}.colour_a), 0.02F);
    EXPECT_LT(glm::distance(scene->floor->colour_b, Floor{}.colour_b), 0.02F);
    EXPECT_EQ(scene->floor->radius, Floor{}.radius);
    EXPECT_EQ(scene->lights[0].towards, defaults.lights[0].towards);
    EXPECT_EQ(scene->lights[0].ambient, defaults.lights[0].ambient);
    EXPECT_EQ(scene->camera->fov_x_rad, CameraPath{}.fov_x_rad);
}

TEST(SceneFile, OtherFormatsAreNamedWithAdvice) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"a.stl", "STL"}, {"a.dae", "COLLADA"},        {"a.3ds", "3D Studio"},
        {"a.FBX", "FBX"}, {"a.blend", "Blender file"}, {"a.usdz", "USD"}};
    for (const auto& [name, format] : cases) {
        const Result<Scene> scene = read_scene(name);
        ASSERT_FALSE(scene) << name;
        EXPECT_THAT(scene.error().message,
                    AllOf(HasSubstr(name + ": is "), HasSubstr(format),
                          HasSubstr("convert it to glTF, for example with Blender: File > Export")));
    }
}

TEST(SceneFile, ErrorsNameTheFileAndTheKey) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {R"({"floor": {"heigth": 0}})", "floor: has a key 'heigth'"},
        {R"({"flor": {}})", "has a key 'flor'"},
        {R"({"floor": {"radius": 0}})", "floor.radius: must be a number from"},
        {R"({"floor": {"radius": "wide"}})", "floor.radius: must be a number"},
        {R"({"floor": []})", "floor: must be an object"},
        {R"({"floor": {"colours": [[0, 0, 0]]}})", "floor.colours: must have 2 to 2 entries"},
        {R"({"background": [0, 0, 1.5]})", "background[2]: must be a number from 0 to 1"},
        {R"({"background": [0, 0]})", "background: must be a list of three numbers"},
        {R"({"lights": {"towards": [0, 0, 0]}})", "lights.towards: must be a direction"},
        {R"({"nodes": {}})", "nodes: must be a list"},
        {R"({"nodes": [{"translate": [0, 0, 0]}]})", "nodes[0]: must have exactly one of"},
        {R"({"nodes": [{"box": [1, 1, 1], "object": "a.rso"}]})", "nodes[0]: must have exactly one of"},
        {R"({"nodes": [{"box": [1, 0, 1]}]})", "nodes[0].box[1]: must be a number"},
        {R"({"nodes": [{"object": ""}]})", "nodes[0].object: must not be empty"},
        {R"({"nodes": [{"object": "a.rso", "standing": 1}]})", "nodes[0].standing: must be true or false"},
        {R"({"nodes": [{"group": [{"box": [1, 1, 1], "scale": -1}]}]})", "nodes[0].group[0].scale: must be a number"},
        {R"({"nodes": [{"box": [1, 1, 1], "rotate": {}}]})", "nodes[0].rotate: degrees is missing"},
        {R"({"nodes": [{"object": "a.rso", "colour": [0, 0, 0]}]})", "nodes[0]: has a key 'colour'"},
        {R"({"camera": {"eye": [0, 0, 1]}})", "camera: at is missing"},
        {R"({"camera": {"eye": [0, 0, 1], "at": [0, 0, 1]}})", "camera: eye and at are the same"},
        {R"({"camera": {"path": [{"eye": [0, 0, 1], "at": [0, 0, 0]}]}})", "camera: frames is missing"},
        {R"({"camera": {"path": [], "frames": 2}})", "camera.path: must have 1 to"},
        {R"({"camera": {"path": [{"eye": [0, 0, 1], "at": [0, 0, 0]}], "frames": 1.5}})",
         "camera.frames: must be a whole"},
        {"{\n\"floor\": {\n", "is not valid JSON at line"},
        {"[]", "must be an object"},
        {R"({"background": [1e999, 0, 0]})", "out of range"},
        {std::string(200, '[') + std::string(200, ']'), "nests brackets"},
    };
    for (const auto& [text, expected] : cases) {
        EXPECT_THAT(scene_error(text), AllOf(HasSubstr("rooms/hall.json: "), HasSubstr(expected), Not(HasSubstr("\n"))))
            << text;
    }
}

TEST(SceneFile, AMissingFileIsNamed) {
    const Result<Scene> scene = read_scene("/nowhere/hall.json");
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().message, HasSubstr("/nowhere/hall.json"));
}

TEST(ObjectArgument, MayHaveAPlaceATurnAndAScale) {
    const auto plain = parse_object_argument("a/vase.rso", {7, 0, 0});
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->file, "a/vase.rso");
    EXPECT_EQ(plain->chain.at(0).translation, glm::dvec3(7, 0, 0));

    const auto placed = parse_object_argument("vase.rso@1,-2.5,3e-1", {7, 0, 0});
    ASSERT_TRUE(placed);
    EXPECT_EQ(placed->file, "vase.rso");
    EXPECT_EQ(placed->chain.at(0).translation, glm::dvec3(1, -2.5, 0.3));
    EXPECT_EQ(placed->chain.at(0).scale, 1);

    const auto full = parse_object_argument("vase.rso@1,2,3,90,0.5", {});
    ASSERT_TRUE(full);
    EXPECT_DOUBLE_EQ(full->chain.at(0).angle_rad, kPi / 2);
    EXPECT_EQ(full->chain.at(0).scale, 0.5);
}

TEST(ObjectArgument, RefusesWhatIsNoPlace) {
    for (const char* wrong : {"a.rso@", "a.rso@1,2", "a.rso@1,2,3,4,5,6", "a.rso@1,2,x", "a.rso@1,2,3,",
                              "a.rso@nan,0,0", "a.rso@1,2,3,0,0", "a.rso@1,2,3,0,-1", "a.rso@1;2;3"}) {
        const auto node = parse_object_argument(wrong, {});
        ASSERT_FALSE(node) << wrong;
        EXPECT_THAT(node.error().message, HasSubstr(wrong));
    }
}

TEST(ObjectArgument, AFileWithASignInItsNameIsAFile) {
    const test::TemporaryFolder folder;
    const std::string path = (folder / "vase@1,2,3").string();
    std::ofstream(path) << "x";
    const auto node = parse_object_argument(path, {});
    ASSERT_TRUE(node);
    EXPECT_EQ(node->file, path);
}

}  // namespace
}  // namespace rs::compositor
