// Street files: deterministic bytes, separate objects, traffic that keeps its distance.

#include "datasets-synthetic/street/street.hpp"
#include "datasets-synthetic/street/street_models.hpp"
#include "datasets-synthetic/street/traffic.hpp"
#include "rayspace/file/file_output.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

namespace rs::synthetic {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::map<std::string, std::string> files_of(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        const auto bytes = read_file(entry.path(), std::uint64_t{1} << 26U);
        EXPECT_TRUE(bytes.ok());
        files[fs::relative(entry.path(), folder).string()] =
            bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "";
    }
    return files;
}

TEST(Street, IsTheSameEveryTime) {
    const test::TemporaryFolder folder;
    StreetOptions options;
    options.scenario = default_scenario();
    options.scenario.seconds = 0.12;
    options.texture_scale = 0.1F;
    for (const char* name : {"a", "b"}) ASSERT_TRUE(write_street(options, folder / name));
    const auto first = files_of(folder / "a");
    EXPECT_EQ(first, files_of(folder / "b"));
    EXPECT_EQ(first.count("maps/street/anim/out/frame-0002.obj"), 1U);
    EXPECT_EQ(first.count("maps/street/anim/out/frame-0003.obj"), 0U);
    EXPECT_EQ(first.count("models/source/cars/cars.obj"), 1U);
    options.scenario.night = true;
    ASSERT_TRUE(write_street(options, folder / "night"));
    EXPECT_THAT(files_of(folder / "night").at("maps/street/anim/out/lights.json"), HasSubstr("street lamp"));
}

TEST(Street, NamesObjectsThatAreNotThere) {
    const test::TemporaryFolder folder;
    StreetOptions options;
    options.scenario = default_scenario();
    options.scenario.seconds = 0.04;
    options.texture_scale = 0.1F;
    options.objects = "..";
    std::ofstream(folder / "vase.rso") << "an object";
    const auto figures = write_street(options, folder / "town");
    ASSERT_TRUE(figures.ok()) << figures.error().message;
    EXPECT_EQ(figures->missing.count("lamp.rso"), 1U);
    EXPECT_EQ(figures->missing.count("vase.rso"), 0U);
    options.objects.clear();
    const auto empty = write_street(options, folder / "empty");
    ASSERT_TRUE(empty.ok()) << empty.error().message;
    EXPECT_TRUE(empty->missing.empty()) << "no windows have objects";
}

TEST(Street, VehiclesStandOnTheirWheels) {
    std::set<std::string> unlit;
    const World world = make_vehicles(false, unlit);
    for (const VehicleModel& model : vehicle_models()) {
        float low = 9;
        float front = -9;
        float back = 9;
        for (const WorldPart& part : world.parts) {
            if (part.room != model.name) continue;
            for (const glm::vec3& p : part.mesh.positions) {
                low = std::min(low, p.y);
                front = std::max(front, p.x);
                back = std::min(back, p.x);
            }
        }
        EXPECT_NEAR(low, 0, 0.02) << model.name;
        EXPECT_NEAR(static_cast<double>(front - back), model.length_m, 0.25) << model.name;
    }
}

// Ninety seconds without collisions between vehicles or on the crossing.
TEST(Street, TrafficKeepsItsDistance) {
    Scenario scenario = default_scenario();
    scenario.seconds = 90;
    scenario.frames_per_second = 10;
    for (TrafficSource& source : scenario.sources) source.count *= 4;
    std::map<std::string, double> length;
    for (const VehicleModel& model : vehicle_models()) length[model.name] = model.length_m;
    int crossed_main = 0;
    int crossed_other = 0;
    for (const TrafficFrame& frame : simulate_traffic(scenario)) {
        bool main = false;
        bool other = false;
        for (std::size_t i = 0; i < frame.vehicles.size(); ++i) {
            const VehiclePose& a = frame.vehicles[i];
            const bool on_crossing = std::max(std::abs(a.place.x), std::abs(a.place.z)) < 3;
            const bool along_x = std::abs(std::remainder(a.turn_deg, 180)) < 1;
            main = main || (on_crossing && along_x);
            other = other || (on_crossing && !along_x);
            for (std::size_t j = 0; j < i; ++j) {
                const VehiclePose& b = frame.vehicles[j];
                if (a.turn_deg != b.turn_deg) continue;
                const double apart = glm::distance(a.place, b.place);
                EXPECT_GT(apart, (length[a.model] + length[b.model]) / 2 + 0.5);
            }
        }
        EXPECT_FALSE(main && other);
        crossed_main += main ? 1 : 0;
        crossed_other += other ? 1 : 0;
    }
    EXPECT_GT(crossed_main, 10);
    EXPECT_GT(crossed_other, 5);
}

TEST(Scenario, IsReadStrictlyAndWrittenAsItIs) {
    const std::string text = scenario_json(default_scenario());
    const auto read = scenario_from_json(text, "s.json");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(scenario_json(*read), text);
    const std::pair<const char*, const char*> faulty[] = {
        {"{", "is not valid JSON"},
        {R"({"sources": [], "seed": 1, "seed": 2})", "is there twice"},
        {"[]", "must be an object"},
        {"{}", "sources is missing"},
        {R"({"sources": [], "secnds": 3})", "'secnds' that means nothing here"},
        {R"({"sources": [], "seconds": 0})", "seconds: must be a number"},
        {R"({"sources": [], "time": "noon"})", "time: must be one of \"day\", \"night\""},
        {R"({"sources": [{"lane": "up"}]})", "sources[0].lane: must be one of \"east\""},
        {R"({"sources": [{}]})", "sources[0]: lane is missing"},
        {R"({"sources": [{"lane": "east", "count": 1.5}]})", "count: must be a whole number"},
        {R"({"sources": [], "camera": {"ride": 0}})", "camera.ride: has no source to ride with; add one"},
        {R"({"sources": [], "camera": {"path": [{"eye": [0, 0, 0], "at": [0, 0, 0]}]}})",
         "camera.path[0]: at is the eye"},
        {R"({"sources": [], "camera": {"path": [{"eye": [0, 0], "at": [0, 0, 1]}]}})",
         "camera.path[0].eye: must be a list"},
    };
    for (const auto& [json, what] : faulty) {
        const auto refused = scenario_from_json(json, "s.json");
        ASSERT_FALSE(refused) << json;
        EXPECT_THAT(refused.error().message, HasSubstr(what));
        EXPECT_EQ(refused.error().message.rfind("s.json", 0), 0U);
    }
}

}  // namespace
}  // namespace rs::synthetic
