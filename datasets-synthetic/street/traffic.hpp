#pragma once
// Traffic simulation: vehicles follow each other and stop at red lights. The same scenario yields the same positions on
// every machine (only + - * / sqrt are used).

#include "datasets-synthetic/street/scenario.hpp"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace rs::synthetic {

// Positions of the lanes in metres from the centre of the crossing.
inline constexpr double kLaneOffset_m = 2;
inline constexpr double kMainReach_m = 150;  // where vehicles of the main street appear and disappear
inline constexpr double kCrossReach_m = 90;

struct VehiclePose {
    std::string model;    // of vehicle_models()
    glm::dvec3 place{0};  // of its centre, on the ground
    double turn_deg = 0;  // about Y; 0: towards +X
};

enum class SignalColour { kRed, kAmber, kGreen };

struct TrafficFrame {
    SignalColour main_signal = SignalColour::kRed;
    SignalColour cross_signal = SignalColour::kRed;
    std::vector<VehiclePose> vehicles;  // without the vehicle that carries the camera
    StreetView view;
};

struct VehicleModel {
    std::string name;
    Vehicle kind = Vehicle::kHatchback;
    double length_m = 4.2;
};
// In the order of the random selection.
const std::vector<VehicleModel>& vehicle_models();

// Simulates the whole scenario; one entry per frame.
std::vector<TrafficFrame> simulate_traffic(const Scenario& scenario);

}  // namespace rs::synthetic
