#include "datasets-synthetic/street/scenario.hpp"

#include "rayspace/base/json_text.hpp"
#include "rayspace/file/file_output.hpp"

#include <utility>

namespace rs::synthetic {
namespace {

constexpr std::uint64_t kMaxScenario_bytes = 1 << 20;
constexpr double kFarthest_m = 1000;
// In the order of Lane and of Vehicle.
const std::vector<std::string> kLanes{"east", "west", "north", "south"};
const std::vector<std::string> kVehicles{"hatchback", "van", "bus", "any"};

glm::dvec3 take_point(JsonObject& object, const char* key) {
    return object.take(key).triple(-kFarthest_m, kFarthest_m);
}

TrafficSource take_source(JsonObject object) {
    TrafficSource source;
    source.lane = static_cast<Lane>(object.take("lane").one_of(kLanes));
    if (object.has("vehicle")) {
        source.vehicle = static_cast<Vehicle>(object.take("vehicle").one_of(kVehicles));
    }
    object.read("first_s", source.first_s, -60, 3600);
    object.read("every_s", source.every_s, 0.5, 3600);
    object.read("count", source.count, 1, 1000);
    object.read("speed_mps", source.speed_mps, 1, 40);
    object.expect_no_unknown_keys();
    return source;
}

void read_camera(JsonObject object, Scenario& scenario) {
    object.read("fov_degrees", scenario.fov_degrees, 10, 140);
    if (object.has("ride")) {
        const JsonValue ride = object.take("ride");
        if (scenario.sources.empty()) throw ride.wrong("has no source to ride with; add one to sources");
        const int last = static_cast<int>(scenario.sources.size()) - 1;
        scenario.ride = static_cast<std::size_t>(ride.whole_number(0, last));
    } else {
        const JsonValue path = object.take("path");
        const std::size_t count = path.list_size(1, 1000);
        scenario.path.clear();
        for (std::size_t i = 0; i < count; ++i) {
            JsonObject view(path.item(i));
            scenario.path.push_back({take_point(view, "eye"), take_point(view, "at")});
            if (scenario.path.back().eye == scenario.path.back().at) throw view.wrong("at is the eye; move one");
            view.expect_no_unknown_keys();
        }
    }
    object.expect_no_unknown_keys();
}

}  // namespace

Scenario default_scenario() {
    Scenario scenario;
    scenario.sources = {
        {Lane::kEast, Vehicle::kAny, -24, 3.1, 11, 10},  {Lane::kWest, Vehicle::kAny, -25, 3.4, 10, 11},
        {Lane::kNorth, Vehicle::kAny, -9, 4.2, 4, 8},    {Lane::kSouth, Vehicle::kHatchback, -8, 5.1, 3, 8},
        {Lane::kEast, Vehicle::kBus, -10.3, 12.4, 2, 9},
    };
    scenario.path = {{{-46, 1.8, 4.15}, {-22, 2.3, -2.5}},
                     {{-34, 1.8, 4.15}, {-10, 2.5, -2.5}},
                     {{-22, 1.8, 4.15}, {3, 2.4, -2}},
                     {{-9.2, 2.3, 4.15}, {15, 2.1, -2}}};
    return scenario;
}

std::string scenario_json(const Scenario& scenario) {
    using nlohmann::ordered_json;
    ordered_json sources = ordered_json::array();
    for (const TrafficSource& source : scenario.sources) {
        sources.push_back({{"lane", kLanes.at(static_cast<std::size_t>(source.lane))},
                           {"vehicle", kVehicles.at(static_cast<std::size_t>(source.vehicle))},
                           {"first_s", source.first_s},
                           {"every_s", source.every_s},
                           {"count", source.count},
                           {"speed_mps", source.speed_mps}});
    }
    ordered_json camera{{"fov_degrees", scenario.fov_degrees}};
    if (scenario.ride) {
        camera["ride"] = *scenario.ride;
    } else {
        const auto triple = [](const glm::dvec3& v) { return ordered_json{v.x, v.y, v.z}; };
        camera["path"] = ordered_json::array();
        for (const StreetView& view : scenario.path) {
            camera["path"].push_back({{"eye", triple(view.eye)}, {"at", triple(view.at)}});
        }
    }
    const ordered_json json{
        {"seconds", scenario.seconds},
        {"frames_per_second", scenario.frames_per_second},
        {"time", scenario.night ? "night" : "day"},
        {"seed", scenario.seed},
        {"lights", {{"main_green_s", scenario.main_green_s}, {"cross_green_s", scenario.cross_green_s}}},
        {"sources", sources},
        {"camera", camera}};
    return json.dump(1) + "\n";
}

Result<Scenario> scenario_from_json(const std::string& text, const std::string& file) {
    return read_json(text, file, [](JsonObject& top) {
        Scenario scenario = default_scenario();
        top.read("seconds", scenario.seconds, 0.1, 3600);
        top.read("frames_per_second", scenario.frames_per_second, 1, 120);
        scenario.night = top.has("time") && top.take("time").one_of({"day", "night"}) == 1;
        int seed = 1;
        top.read("seed", seed, 0, 1'000'000'000);
        scenario.seed = static_cast<std::uint32_t>(seed);
        if (top.has("lights")) {
            JsonObject lights(top.take("lights"));
            lights.read("main_green_s", scenario.main_green_s, 2, 600);
            lights.read("cross_green_s", scenario.cross_green_s, 2, 600);
            lights.expect_no_unknown_keys();
        }
        const JsonValue sources = top.take("sources");
        const std::size_t count = sources.list_size(0, 100);
        scenario.sources.clear();
        for (std::size_t i = 0; i < count; ++i) scenario.sources.push_back(take_source(JsonObject(sources.item(i))));
        if (const auto found = top.find("camera")) read_camera(JsonObject(*found), scenario);
        return scenario;
    });
}

Result<Scenario> read_scenario(const std::filesystem::path& path) {
    RS_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, read_file(path, kMaxScenario_bytes));
    return scenario_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
}

}  // namespace rs::synthetic
