#pragma once
// Bodies of vehicles as lofts: cross-sections along X, each given by the heights of its roof line and belt line and by
// its width, with round wheel arches and windows. Vehicles face +X and stand on y = 0.

#include "datasets-synthetic/street/pen.hpp"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace rs::synthetic {

// A function of x in metres: straight between these points (x, value), which have increasing x, with rounded corners.
using Profile = std::vector<glm::vec2>;

struct CarShape {
    Profile roof;   // height of the centre line: bonnet, screens, roof
    Profile belt;   // height of the line below the side windows
    Profile width;  // half of the body's width
    float sill = 0.2F;
    float lean = 0.28F;        // of the side windows: metres inwards per metre up
    float rounding_m = 0.1F;   // of the profiles' corners
    std::vector<float> axles;  // x of the wheels' centres
    float wheel_radius = 0.31F;
    std::vector<glm::vec2> side_windows;  // x from, to
    std::vector<glm::vec2> screens;       // windscreen and rear window: x from, to
    std::vector<float> seams{};           // x of gaps around doors
    bool glass_ends = false;              // windows in the front and the back end, as buses have
    std::string side_glass = "car_glass";
};

// Body with windows, wheel wells and wheels; looks: `paint`, "car_glass", "trim", "grille", "tyre", "rim".
void build_car_body(Pen& pen, const std::string& paint, const CarShape& shape);

float profile_at(const Profile& profile, float x, float rounding_m);

}  // namespace rs::synthetic
