#pragma once
// Street scenario from JSON: traffic, traffic lights, time of day and camera.
//
//     { "seconds": 10, "frames_per_second": 25, "time": "day", "seed": 1,
//       "lights": {"main_green_s": 9, "cross_green_s": 6},
//       "sources": [
//         {"lane": "east", "vehicle": "any", "first_s": -12, "every_s": 3.2, "count": 12, "speed_mps": 10},
//         {"lane": "north", "vehicle": "van", "first_s": -8, "every_s": 7, "count": 3, "speed_mps": 8} ],
//       "camera": {"path": [{"eye": [-30, 2, 5], "at": [0, 2, 0]}, {"eye": [20, 3, 5], "at": [30, 1, 0]}],
//                  "fov_degrees": 65} }
//
// Lanes: east and west on the main street, which runs along X; north and south on the one that crosses it. Vehicles:
// hatchback, van, bus or any. A camera has a "path", or "ride": the index of a source whose first vehicle carries it.
// Unknown keys are errors. Everything but "sources" is optional.

#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rs::synthetic {

enum class Lane { kEast, kWest, kNorth, kSouth };
enum class Vehicle { kHatchback, kVan, kBus, kAny };

// Source of vehicles at the beginning of a lane.
struct TrafficSource {
    Lane lane = Lane::kEast;
    Vehicle vehicle = Vehicle::kAny;
    double first_s = 0;  // negative: vehicles are already on the road at the start of the sequence
    double every_s = 4;
    int count = 1;
    double speed_mps = 10;
};

struct StreetView {
    glm::dvec3 eye{0};
    glm::dvec3 at{0};
};

struct Scenario {
    double seconds = 10;
    double frames_per_second = 25;
    bool night = false;
    std::uint32_t seed = 1;
    double main_green_s = 9;
    double cross_green_s = 6;
    std::vector<TrafficSource> sources;
    std::vector<StreetView> path;     // keys at equal time steps, smoothly interpolated
    std::optional<std::size_t> ride;  // replaces the path
    double fov_degrees = 65;
};

// Ten seconds by day with about twenty vehicles.
Scenario default_scenario();

// JSON text that scenario_from_json() reads back unchanged.
std::string scenario_json(const Scenario& scenario);

// Errors name file, key and solution.
Result<Scenario> scenario_from_json(const std::string& text, const std::string& file);
Result<Scenario> read_scenario(const std::filesystem::path& path);

}  // namespace rs::synthetic
