#include "datasets-synthetic/street/scenario.hpp"

#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace rs::synthetic {
namespace {

constexpr std::uint64_t kMaxScenario_bytes = 1 << 20;
constexpr double kFarthest_m = 1000;

struct MalformedScenario {
    std::string message;
};

// A JSON object whose keys are all to be asked for.
class Keys {
public:
    Keys(const nlohmann::json& json, std::string place) : json_(json), place_(std::move(place)) {
        if (!json_.is_object()) fail("", "must be an object {...}");
    }

    [[noreturn]] void fail(const std::string& key, const std::string& what) const {
        throw MalformedScenario{printable(place_ + (key.empty() ? "" : ": " + key)) + ": " + what};
    }
    const nlohmann::json* find(const char* key) {
        asked_.insert(key);
        const auto found = json_.find(key);
        return found == json_.end() ? nullptr : &*found;
    }
    const nlohmann::json& at(const char* key) {
        const nlohmann::json* const found = find(key);
        if (found == nullptr) fail(key, "is missing; add it");
        return *found;
    }
    double number(const char* key, double otherwise, double low, double high) {
        const nlohmann::json* const found = find(key);
        if (found == nullptr) return otherwise;
        const double value = found->is_number() ? found->get<double>() : NAN;
        if (!(value >= low && value <= high)) {
            std::array<char, 64> range{};
            std::snprintf(range.data(), range.size(), "must be a number, %g..%g", low, high);
            fail(key, range.data());
        }
        return value;
    }
    int whole(const char* key, int otherwise, int low, int high) {
        const double value = number(key, otherwise, low, high);
        if (value != std::floor(value)) fail(key, "must be a whole number");
        return static_cast<int>(value);
    }
    // The place of the word in `words`.
    std::size_t word(const char* key, std::size_t otherwise, const std::vector<std::string>& words) {
        const nlohmann::json* const found = find(key);
        if (found == nullptr) return otherwise;
        std::string known;
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (found->is_string() && found->get<std::string>() == words[i]) return i;
            known += (i == 0 ? "" : ", ") + words[i];
        }
        fail(key, "must be one of " + known);
    }
    const nlohmann::json& list(const char* key, std::size_t least, std::size_t most) {
        const nlohmann::json& value = at(key);
        if (!value.is_array() || value.size() < least || value.size() > most) {
            fail(key, "must be a list of " + std::to_string(least) + ".." + std::to_string(most));
        }
        return value;
    }
    glm::dvec3 triple(const char* key) {
        const nlohmann::json& value = list(key, 3, 3);
        glm::dvec3 result(0);
        for (std::size_t i = 0; i < 3; ++i) {
            const double number = value[i].is_number() ? value[i].get<double>() : NAN;
            if (!(std::abs(number) <= kFarthest_m)) fail(key, "must be three numbers, -1000..1000");
            result[static_cast<int>(i)] = number;
        }
        return result;
    }
    void finish() const {
        for (const auto& [key, value] : json_.items()) {
            if (asked_.contains(key)) continue;
            std::string known;
            for (const std::string& name : asked_) known += (known.empty() ? "" : ", ") + name;
            fail(key, "is no key here; take it out (known: " + known + ")");
        }
    }

private:
    const nlohmann::json& json_;
    std::string place_;
    std::set<std::string> asked_;
};

TrafficSource source_of(Keys keys) {
    TrafficSource source;
    static_cast<void>(keys.at("lane"));
    source.lane = static_cast<Lane>(keys.word("lane", 0, {"east", "west", "north", "south"}));
    source.vehicle = static_cast<Vehicle>(keys.word("vehicle", 3, {"hatchback", "van", "bus", "any"}));
    source.first_s = keys.number("first_s", 0, -60, 3600);
    source.every_s = keys.number("every_s", 4, 0.5, 3600);
    source.count = keys.whole("count", 1, 1, 1000);
    source.speed_mps = keys.number("speed_mps", 10, 1, 40);
    keys.finish();
    return source;
}

void read_camera(Keys keys, const std::string& place, Scenario& scenario) {
    scenario.fov_degrees = keys.number("fov_degrees", scenario.fov_degrees, 10, 140);
    if (keys.find("ride") != nullptr) {
        const int last = static_cast<int>(scenario.sources.size()) - 1;
        scenario.ride = static_cast<std::size_t>(keys.whole("ride", 0, 0, last));
    } else {
        const nlohmann::json& path = keys.list("path", 1, 1000);
        scenario.path.clear();
        for (std::size_t i = 0; i < path.size(); ++i) {
            Keys view(path[i], place + ": path[" + std::to_string(i) + "]");
            scenario.path.push_back({view.triple("eye"), view.triple("at")});
            if (scenario.path.back().eye == scenario.path.back().at) view.fail("at", "is the eye; move one");
            view.finish();
        }
    }
    keys.finish();
}

}  // namespace

Scenario usual_scenario() {
    Scenario scenario;
    scenario.sources = {
        {Lane::kEast, Vehicle::kAny, -24, 3.1, 11, 10},  {Lane::kWest, Vehicle::kAny, -25, 3.4, 10, 11},
        {Lane::kNorth, Vehicle::kAny, -9, 4.2, 4, 8},    {Lane::kSouth, Vehicle::kHatchback, -8, 5.1, 3, 8},
        {Lane::kEast, Vehicle::kBus, -10.3, 12.4, 2, 9},
    };
    scenario.path = {{{-44, 1.9, 5.6}, {-20, 2.2, -2}},
                     {{-30, 2.0, 5.4}, {-8, 2.3, -1}},
                     {{-17, 2.6, 5.0}, {6, 2.0, -3}},
                     {{-8, 4.2, 5.2}, {14, 1.2, -3}}};
    return scenario;
}

std::string scenario_json(const Scenario& scenario) {
    using nlohmann::ordered_json;
    static constexpr std::array kLanes{"east", "west", "north", "south"};
    static constexpr std::array kVehicles{"hatchback", "van", "bus", "any"};
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
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_discarded()) return Error{printable(file) + ": is no JSON; mend it (scenario.hpp shows one)"};
    Scenario scenario = usual_scenario();
    try {
        Keys top(json, file);
        scenario.seconds = top.number("seconds", scenario.seconds, 0.1, 3600);
        scenario.frames_per_second = top.number("frames_per_second", scenario.frames_per_second, 1, 120);
        scenario.night = top.word("time", 0, {"day", "night"}) == 1;
        scenario.seed = static_cast<std::uint32_t>(top.whole("seed", 1, 0, 1'000'000'000));
        if (const nlohmann::json* lights = top.find("lights")) {
            Keys keys(*lights, file + ": lights");
            scenario.main_green_s = keys.number("main_green_s", scenario.main_green_s, 2, 600);
            scenario.cross_green_s = keys.number("cross_green_s", scenario.cross_green_s, 2, 600);
            keys.finish();
        }
        const nlohmann::json& sources = top.list("sources", 0, 100);
        scenario.sources.clear();
        for (std::size_t i = 0; i < sources.size(); ++i) {
            scenario.sources.push_back(source_of(Keys(sources[i], file + ": sources[" + std::to_string(i) + "]")));
        }
        if (const nlohmann::json* camera = top.find("camera")) {
            read_camera(Keys(*camera, file + ": camera"), file + ": camera", scenario);
        }
        top.finish();
    } catch (const MalformedScenario& malformed) {
        return Error{malformed.message};
    }
    return scenario;
}

Result<Scenario> read_scenario(const std::filesystem::path& path) {
    const Result<std::vector<std::byte>> bytes = read_file(path, kMaxScenario_bytes);
    if (!bytes) return bytes.error();
    return scenario_from_json({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path.string());
}

}  // namespace rs::synthetic
