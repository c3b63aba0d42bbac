#pragma once
// JSON light list of a scene, exported and edited separately from it:
//
//     { "replace": true,                           removes the scene's own lights (false)
//       "lights": [
//         { "kind": "luminaire", "file": "downlight.ies", "location": [0, 2.4, 0], "aim": [0, -1, 0], "turn_deg": 0 },
//         { "kind": "rectangle", "location": [0, 2.4, 0], "aim": [0, -1, 0], "size": [1.2, 0.3], "lumens": 3000 },
//         { "kind": "disc", "location": [0, 2, 1], "aim": [0, -1, 0], "size": 0.4, "radiance": [5, 5, 5] },
//         { "kind": "point", "location": [0, 1, 0], "candela": 40 },
//         { "kind": "spot", "location": [0, 2, 0], "aim": [0, -1, 0], "candela": 300, "beam_deg": 20, "cut_off_deg": 30
//         }, { "kind": "directional", "aim": [-1, -2, 0], "lux": 20000 } ],
//       "environment": { "file": "sky.hdr", "scale": 1, "turn_deg": 0, "seen": true } }
//
// Optional for each light: "name" and "colour" [r, g, b], a factor in linear light (1, 1, 1). Photometric values are
// divided by kLumensPerWatt. "beam_deg" and "cut_off_deg" are full angles. "turn_deg" rotates an area or a luminaire
// about its aim, counter-clockwise when looking along -aim; at 0 its plane C0 is oriented towards +X, or towards +Z if
// it is aimed along X. "dimmer" (1) is a factor on a luminaire. The environment is an image as in EnvironmentLight;
// "seen" (false) makes it the background of images. File names are relative to the list's folder. Lengths are in
// scene units, which luminaires and candela assume to be metres.
//
// Extensions for the lights of scene files: for points and spots, instead of candela, an "intensity" [r, g, b], the
// colour of a white diffuse surface, with an "attenuation" [c0, c1, c2] ([1, 0, 0]) that falls off as min(1 / (c0 + c1
// d + c2 d^2), 1), and a "reach" beyond which there is no light; for all an "ambient" [r, g, b]; and "scope", for
// lights that apply to parts of the scene: the index from 0 of the light in the scene's file that has the same scope.
// The list itself may have "headlight": true.

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
    // Lights and environment that the entries describe.
    std::vector<Light> lights;
    std::optional<EnvironmentLight> environment;
};
std::optional<EnvironmentLight> environment_of(const std::optional<EnvironmentEntry>& entry);

/// Errors name file, key and remedy. Files beyond 4 MiB and lists of more than 4096 lights are rejected. Thread-safe.
Result<LightList> read_light_list(const std::filesystem::path& path);

/// Same from text; reads only the files that the list refers to.
Result<LightList> light_list_from_json(const std::string& text, const std::filesystem::path& path);

/// Text of a list to be saved at `path`; reading it gives the same entries. Fails for luminaires and environments
/// without a file, and for values outside of the limits.
Result<std::string> light_list_to_json(const LightList& list, const std::filesystem::path& path);
Status write_light_list(const LightList& list, const std::filesystem::path& path);

}  // namespace rs::compositor
