#pragma once
// frames.json: the files of a sequence, in the folder structure of traffic simulators:
//
//     maps/NAME/anim/out/frames.json
//     { "base": "../../../../models/scene.obj",          static scene of any format (a floor)
//       "models": ["../../../../models/cars.obj"],       objects that instances name, besides the base's
//       "frames": ["frame-0001.obj", "frame-0002.obj"],  extended OBJ, one a frame
//       "frames_per_second": 25,
//       "lights": "night.json",                          a list of lights (scene/light/lights_file.hpp)
//       "background": {"zenith": [0.3, 0.5, 0.8], "horizon": [0.8, 0.85, 0.9]},     sRGB
//       "haze_m": 2500,                                  exponential fog of the horizon's colour: its visibility, m
//       "weather": "rain,fog", "seed": 1 }
//
// Only "frames" is required. Paths are relative to the file's folder.

#include "compositor/scene/surroundings.hpp"
#include "compositor/scene/weather.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

inline constexpr std::size_t kMaxFrames = 100'000;

struct SequenceFiles {
    std::filesystem::path file;  // frames.json
    std::optional<std::filesystem::path> base;
    std::vector<std::filesystem::path> models;
    std::vector<std::filesystem::path> frames;  // at least one
    double frames_per_second = 25;
    std::optional<std::filesystem::path> lights;
    std::optional<Background> background;
    std::optional<double> haze_m;
    std::optional<Weather> weather;
};

/// \param folder folder of a map; folder with frames.json in it, in out/ or in anim/out/; folder with a single map in
/// maps/; frames.json itself; or one extended OBJ, a sequence of one frame.
Result<SequenceFiles> find_sequence(const std::filesystem::path& folder);

// At most 16 MiB. Pure.
Result<SequenceFiles> frames_from_json(const std::string& text, const std::filesystem::path& file);

}  // namespace rs::compositor
