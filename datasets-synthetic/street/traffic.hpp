#pragma once
// Traffic, simulated: vehicles follow one another and stop at red lights. The same scenario gives the same positions on
// every machine (only + - * / sqrt decide).

#include "datasets-synthetic/street/scenario.hpp"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace rs::synthetic {

// Where lanes lie: metres from the middle of the crossing.
inline constexpr double kLaneOffset_m = 2;
inline constexpr double kMainReach_m = 150;  // vehicles of the main street come and go there
inline constexpr double kCrossReach_m = 90;

struct VehiclePlace {
    std::string model;    // of vehicle_models()
    glm::dvec3 place{0};  // of its middle, on the ground
    double turn_deg = 0;  // about Y; at 0 it drives towards +X
};

struct TrafficFrame {
    std::vector<VehiclePlace> vehicles;  // but for the one that is ridden
    StreetView view;
};

struct VehicleModel {
    std::string name;
    Vehicle kind = Vehicle::kHatchback;
    double length_m = 4.2;
};
// In the order in which chance draws them.
const std::vector<VehicleModel>& vehicle_models();

// One for each frame; of the whole scenario.
std::vector<TrafficFrame> simulate_traffic(const Scenario& scenario);

}  // namespace rs::synthetic
