#pragma once
// Writes a street with traffic as the files of a sequence:
//
//     OUT/maps/NAME/anim/configs/scenario.json      the scenario
//     OUT/maps/NAME/anim/out/frames.json            names all other files; frame-0000.obj, ... lights.json, sky.exr
//     OUT/models/street.obj                         houses, road, lamps, trees, ray-space objects in shop windows
//     OUT/models/source/cars/cars.obj               vehicles
//
// Metres, Y up. The same scenario yields the same bytes on every machine.

#include "datasets-synthetic/street/scenario.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <set>
#include <string>

namespace rs::synthetic {

struct StreetOptions {
    Scenario scenario;
    std::string name = "street";  // of the map
    std::string objects;          // folder of vase.rso etc., relative to OUT; empty: shops without objects
    float texture_scale = 1;      // (0, 1]
    bool force = false;           // replace an existing folder whatever it holds (StagedFolder)
};

struct StreetStatistics {
    std::size_t static_triangles = 0;  // including all instances
    std::size_t vehicles = 0;          // largest number in a frame
    std::size_t frames = 0;
    std::set<std::string> missing;  // ray-space objects of shop windows whose files do not exist
};

Result<StreetStatistics> write_street(const StreetOptions& options, const std::filesystem::path& output);

}  // namespace rs::synthetic
