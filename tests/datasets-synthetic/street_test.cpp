// Street files: deterministic bytes, separate objects, traffic that keeps its distance.

#include "datasets-synthetic/street/street.hpp"
#include "datasets-synthetic/street/sky.hpp"
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
    EXPECT_THAT(first.at("maps/street/anim/out/frame-0002.obj"), HasSubstr("instance signal_"));
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

TEST(Street, CarBodiesAreSmoothAndSymmetric) {
    std::set<std::string> unlit;
    const World world = make_vehicles(false, unlit);
    for (const VehicleModel& model : vehicle_models()) {
        float widest = 0;
        float leftmost = 0;
        std::size_t triangles = 0;
        for (const WorldPart& part : world.parts) {
            if (part.room != model.name) continue;
            triangles += part.mesh.triangles.size();
            for (std::size_t i = 0; i < part.mesh.positions.size(); ++i) {
                ASSERT_NEAR(glm::length(part.mesh.normals[i]), 1, 1e-3F) << model.name << " " << part.look;
                widest = std::max(widest, part.mesh.positions[i].z);
                leftmost = std::min(leftmost, part.mesh.positions[i].z);
            }
        }
        EXPECT_NEAR(widest, -leftmost, 0.02) << model.name;
        EXPECT_LT(triangles, 6000U) << model.name;
    }
}

TEST(Street, TreesKeepTheirLeavesAboveTheGround) {
    World world;
    RoomBuilder builder(world, "street", 0.25F);
    add_tree_looks(world, builder, 0.25F);
    world.looks["soil"] = {};
    build_trees(world);
    std::map<std::string, float> lowest;
    for (const WorldPart& part : world.parts) {
        if (part.look.rfind("foliage", 0) != 0) continue;
        float& low = lowest.emplace(part.room, 9.0F).first->second;
        for (const glm::vec3& p : part.mesh.positions) low = std::min(low, p.y);
    }
    for (int i = 0; i < kTrees; ++i) EXPECT_GT(lowest.at("tree_" + std::to_string(i)), 1.9F) << "people walk below";
    for (int kind = 0; kind < 2; ++kind) {
        std::size_t opaque = 0;
        const auto& image = world.textures.at("foliage_" + std::to_string(kind) + ".png");
        for (const Rgba8& p : image.pixels()) {
            EXPECT_TRUE(p.a == 0 || p.a == 255) << "leaves are masks, which need no sorting";
            opaque += p.a == 255 ? 1U : 0U;
        }
        const auto share = static_cast<double>(opaque) / static_cast<double>(image.pixels().size());
        EXPECT_GT(share, 0.35);
        EXPECT_LT(share, 0.9);
    }
}

TEST(Street, TheSkyIsBlueAboveBrightAtTheSunAndFinite) {
    const glm::vec3 sun = -glm::normalize(kSunAim);
    const glm::vec3 at_sun = day_sky(sun);
    const glm::vec3 opposite = day_sky(glm::normalize(glm::vec3{-sun.x, sun.y, -sun.z}));
    EXPECT_GT(at_sun.r + at_sun.g, opposite.r + opposite.g);
    const Image<RgbaF> image = sky_image(false, 32);
    int blue = 0;
    for (const RgbaF& p : image.pixels()) {
        ASSERT_TRUE(std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b));
        ASSERT_GE(std::min({p.r, p.g, p.b}), 0);
        blue += p.b > 1.5F * p.r ? 1 : 0;
    }
    EXPECT_GT(blue, 32 * 64 / 8);
}

TEST(Street, TrafficLightsAgreeWithTheTraffic) {
    Scenario scenario = default_scenario();
    scenario.seconds = 40;
    std::set<SignalColour> seen;
    for (const TrafficFrame& frame : simulate_traffic(scenario)) {
        EXPECT_TRUE(frame.main_signal == SignalColour::kRed || frame.cross_signal == SignalColour::kRed);
        seen.insert(frame.main_signal);
    }
    EXPECT_EQ(seen.size(), 3U);
}

// At a rate that is no multiple of the simulation's step: no jump, and no change of speed beyond hard braking.
TEST(Street, VehiclesMoveSmoothly) {
    Scenario scenario = default_scenario();
    scenario.sources = {{Lane::kEast, Vehicle::kVan, -24, 60, 1, 10}};
    scenario.seconds = 20;
    scenario.frames_per_second = 30;
    const double step_s = 1 / scenario.frames_per_second;
    std::vector<double> x;
    for (const TrafficFrame& frame : simulate_traffic(scenario)) {
        if (!frame.vehicles.empty()) x.push_back(frame.vehicles.front().place.x);
    }
    ASSERT_GT(x.size(), 100U);
    for (std::size_t i = 2; i < x.size(); ++i) {
        const double change = std::abs((x[i] - x[i - 1]) - (x[i - 1] - x[i - 2])) / step_s;
        EXPECT_LT(change, 9 * 2 * step_s) << "frame " << i << ": m/s within a frame";
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
