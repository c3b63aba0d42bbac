#pragma once
// A street with traffic as the files of a sequence:
//
//     OUT/maps/NAME/anim/configs/scenario.json      the scenario
//     OUT/maps/NAME/anim/out/frames.json            names all that follows; frame-0000.obj, ... lights.json, sky.png
//     OUT/models/street.obj                         houses, road, lamps, trees, ray-space objects in shop windows
//     OUT/models/source/cars/cars.obj               vehicles
//
// Metres, Y up. The same scenario gives the same bytes on every machine.

#include "datasets-synthetic/street/scenario.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <set>
#include <string>

namespace rs::synthetic {

struct StreetOptions {
    Scenario scenario;
    std::string name = "street";  // of the map
    std::string objects;          // folder of vase.rso and so on, as seen from OUT; empty: shops without objects
    float texture_scale = 1;      // (0, 1]
};

struct StreetFigures {
    std::size_t static_triangles = 0;  // as they are shown: instances count
    std::size_t vehicles = 0;          // that are ever seen
    std::size_t frames = 0;
    std::set<std::string> missing;  // ray-space objects of its shop windows that are not where it looks for them
};

Result<StreetFigures> write_street(const StreetOptions& options, const std::filesystem::path& output);

}  // namespace rs::synthetic
