#pragma once
// The procedural objects: made by code alone, from a name, parameters and a seed, the same bits on every machine.
//
// An object's bounding box is centred on the origin and its farthest vertex is at distance 1; Y is up. It comes without
// lights and environment: a recipe (recipes/NAME.json) adds those. The parameters of each stand at the head of its
// header (vase.hpp ...).

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace rs::synthetic {

// In the order in which they should be listed.
std::vector<std::string> object_names();

// `parameters` is a JSON object (or null: all defaults). Fails for a name that object_names() does not list, and for a
// parameter that the object does not have or whose value is out of range; the message lists what there is. Thread-safe.
// Takes 0.1 to 2 s.
Result<capture::Scene> generate(const std::string& name, const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
