#include "compositor/displays/walls_file.hpp"

#include "rayspace/base/conventions.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace rs::compositor {
namespace {

using ::testing::HasSubstr;

constexpr const char* kWallJson =
    R"({"name": "w", "lower_left": [0, 0, 0], "lower_right": [2, 0, 0], "upper_left": [0, 1, 0], "pixels": [40, 20]})";

std::string file_of(const std::string& rest, const std::string& walls = kWallJson) {
    return "{\"walls\": [" + walls + "]" + rest + "}";
}

std::string fault_of(const std::string& text) {
    const auto display = walls_from_json(text, "walls.json");
    return display ? std::string() : display.error().message;
}

TEST(WallsFile, SaysWhereWallsAndHeadAre) {
    const auto display = walls_from_json(
        file_of(R"(, "head": {"position": [1, 0.5, 3], "heading_deg": 90, "pitch_deg": 10, "roll_deg": -5},
                  "eye_distance": 0.06, "units_per_metre": 100,
                  "place": {"position": [7, 8, 9], "heading_deg": 180})"),
        "walls.json");
    ASSERT_TRUE(display.ok()) << display.error().message;
    ASSERT_EQ(display->walls.size(), 1U);
    EXPECT_EQ(display->walls[0].name, "w");
    EXPECT_EQ(display->walls[0].lower_right, glm::dvec3(2, 0, 0));
    EXPECT_EQ(display->walls[0].width, 40);
    EXPECT_EQ(display->head.position, glm::dvec3(1, 0.5, 3));
    EXPECT_DOUBLE_EQ(display->head.heading_rad, kPi / 2);
    EXPECT_DOUBLE_EQ(display->head.roll_rad, radians(-5));
    EXPECT_EQ(display->eye_distance_m, 0.06);
    ASSERT_TRUE(display->place.has_value());
    EXPECT_EQ(display->place->units_per_metre, 100);
    EXPECT_DOUBLE_EQ(display->place->heading_rad, kPi);
}

TEST(WallsFile, ATrackerMayHaveItsZeroElsewhere) {
    EXPECT_FALSE(walls_from_json(file_of(""), "walls.json")->tracker.has_value());
    const auto display =
        walls_from_json(file_of(R"(, "tracker": {"position": [0, 2.5, -1], "heading_deg": 180})"), "walls.json");
    ASSERT_TRUE(display.ok()) << display.error().message;
    ASSERT_TRUE(display->tracker.has_value());
    EXPECT_EQ(display->tracker->position, glm::dvec3(0, 2.5, -1));
    EXPECT_DOUBLE_EQ(display->tracker->heading_rad, kPi);
    EXPECT_THAT(fault_of(file_of(R"(, "tracker": {"position": [0, 0, 0], "roll_deg": 1})")),
                HasSubstr("'roll_deg' that means nothing"));
    EXPECT_THAT(fault_of(file_of(R"(, "tracker": {})")), HasSubstr("tracker: position is missing"));
}

TEST(WallsFile, PresetsAreWalls) {
    for (const char* name : {"cave", "power-wall", "tabletop"}) {
        const auto display = preset_display(name);
        ASSERT_TRUE(display.has_value()) << name;
        for (const Wall& wall : display->walls) {
            EXPECT_TRUE(check_wall(wall).ok());
            // The preset's head is in front of all walls.
            EXPECT_TRUE(wall_camera(wall, display->head.position, {}).ok()) << name << " " << wall.name;
        }
    }
    EXPECT_EQ(preset_display("cave")->walls.size(), 4U);
    EXPECT_FALSE(preset_display("dome").has_value());
}

TEST(WallsFile, WhatIsWrongIsNamed) {
    EXPECT_THAT(fault_of("{"), HasSubstr("walls.json: "));
    EXPECT_THAT(fault_of("{}"), HasSubstr("walls is missing"));
    EXPECT_THAT(fault_of("{\"walls\": []}"), HasSubstr("1 to 64 entries"));
    EXPECT_THAT(fault_of(file_of(", \"heads\": 1")), HasSubstr("'heads' that means nothing"));
    EXPECT_THAT(fault_of(file_of(", \"eye_distance\": -1")), HasSubstr("eye_distance: must be a number from 0 to 1"));
    EXPECT_THAT(fault_of(file_of(", \"fit_scene\": true, \"place\": {\"position\": [0, 0, 0]}")), HasSubstr("place: "));
    EXPECT_THAT(fault_of(file_of("", std::string(kWallJson) + "," + kWallJson)),
                HasSubstr("walls[1]: is another wall 'w'"));
    const auto with = [](const std::string& from, const std::string& to) {
        std::string wall = kWallJson;
        return fault_of(file_of("", wall.replace(wall.find(from), from.size(), to)));
    };
    EXPECT_THAT(with("\"w\"", "\"../w\""), HasSubstr("walls[0].name: names files"));
    EXPECT_THAT(with("[0, 1, 0]", "[1, 1, 0]"), HasSubstr("walls[0]: wall 'w' has no right angle"));
    EXPECT_THAT(with("[40, 20]", "[40, 0]"), HasSubstr("walls[0].pixels[1]: must be a whole number from 1"));
    EXPECT_THAT(with("[2, 0, 0]", "[2, 0]"), HasSubstr("walls[0].lower_right: must be a list of three numbers"));
}

TEST(WallsFile, HeadsComeFrameByFrame) {
    const auto heads =
        heads_from_json(R"({"heads": [{"position": [0, 1, 2]}, {"position": [3, 4, 5], "roll_deg": 9}]})", "walk.json");
    ASSERT_TRUE(heads.ok()) << heads.error().message;
    ASSERT_EQ(heads->size(), 2U);
    EXPECT_EQ((*heads)[1].position, glm::dvec3(3, 4, 5));
    const auto wrong = heads_from_json(R"({"heads": [{"position": [0, 1, 2], "tilt": 1}]})", "walk.json");
    ASSERT_FALSE(wrong.ok());
    EXPECT_THAT(wrong.error().message, HasSubstr("walk.json: heads[0]: has a key 'tilt'"));
}

TEST(WallsFile, WallsAreChosenByName) {
    WallDisplay cave = *preset_display("cave");
    EXPECT_THAT(select_walls(cave, "front,roof").error().message,
                HasSubstr("no wall 'roof'; there are left, front, right, floor"));
    ASSERT_TRUE(select_walls(cave, "right,front").ok());
    ASSERT_EQ(cave.walls.size(), 2U);
    EXPECT_EQ(cave.walls[0].name, "front");
}

TEST(WallsFile, IsReadFromDisk) {
    test::TemporaryFolder folder;
    const auto path = folder.path() / "walls.json";
    EXPECT_FALSE(read_walls(path).ok());
    std::ofstream(path) << file_of("");
    EXPECT_TRUE(read_walls(path).ok());
}

}  // namespace
}  // namespace rs::compositor
