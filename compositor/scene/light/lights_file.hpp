#pragma once
// A list of lights beside a scene, so that they can be exported and changed by themselves:
//
//     { "replace": true,                           the scene's own lights go (false)
//       "lights": [
//         { "kind": "luminaire", "file": "downlight.ies", "location": [0, 2.4, 0], "aim": [0, -1, 0], "turn_deg": 0 },
//         { "kind": "rectangle", "location": [0, 2.4, 0], "aim": [0, -1, 0], "size": [1.2, 0.3], "lumens": 3000 },
//         { "kind": "disc", "location": [0, 2, 1], "aim": [0, -1, 0], "size": 0.4, "radiance": [5, 5, 5] },
//         { "kind": "point", "location": [0, 1, 0], "candela": 40 },
//         { "kind": "spot", "location": [0, 2, 0], "aim": [0, -1, 0], "candela": 300, "beam_deg": 20, "cut_off_deg": 30
//         }, { "kind": "directional", "aim": [-1, -2, 0], "lux": 20000 } ],
//       "environment": { "file": "sky.hdr", "scale": 1, "turn_deg": 0, "seen": true } }
//
// Each may have a "name" and a "colour" [r, g, b], a factor in linear light (1, 1, 1). Photometric numbers are divided
// by kLumensPerWatt. "beam_deg" and "cut_off_deg" are full angles. "turn_deg" turns an area or a luminaire about its
// aim, counter-clockwise as seen looking along -aim; at 0 its plane C0 lies where +X is best seen, or +Z where it is
// aimed along X. "dimmer" (1) is a factor on a luminaire. An environment is an image as EnvironmentLight needs it;
// "seen" (false) puts it behind everything where light is traced. Files are named from the list's folder. Lengths are
// the scene's; luminaires and candela take them for metres.
//
// What lights of scene files have besides, so that they can be written down: points and spots, in place of candela, an
// "intensity" [r, g, b], what white matter shows, and an "attenuation" [c0, c1, c2] ([1, 0, 0]), which fall off as
// min(1 / (c0 + c1 d + c2 d^2), 1); a "reach" beyond which there is no light; all an "ambient" [r, g, b]; and "scope",
// for lights that shine on parts of the scene only: the number of the light in the scene's file, from 0, that shone on
// the same parts. The list itself may have "headlight": true.

#include "compositor/scene/surroundings.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/light/light.hpp"
#include "rayspace/light/light_entry.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

struct LightList {
    bool replace = false;
    bool headlight = false;
    std::vector<LightEntry> entries;
    std::optional<EnvironmentEntry> environment_entry;
    // What they state.
    std::vector<Light> lights;
    std::optional<EnvironmentLight> environment;
};
std::optional<EnvironmentLight> environment_of(const std::optional<EnvironmentEntry>& entry);

// Errors name file, key and remedy. Files beyond 4 MiB and lists of more than 4096 lights are refused. Thread-safe.
Result<LightList> read_light_list(const std::filesystem::path& path);

// The part that needs no file but those that are named in it.
Result<LightList> light_list_from_json(const std::string& text, const std::filesystem::path& path);

// The text of a list that will stand at `path`: what is read of it has the same entries. Refuses luminaires and
// environments that came from no file, and numbers that no list may hold.
Result<std::string> light_list_to_json(const LightList& list, const std::filesystem::path& path);
Status write_light_list(const LightList& list, const std::filesystem::path& path);

}  // namespace rs::compositor
