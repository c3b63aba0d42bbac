#pragma once
// Procedural objects, generated from a name, parameters and a seed, bit-identical on every machine.
//
// An object's bounding box is centred on the origin and its farthest vertex is at distance 1; Y is up. Recipes
// (recipes/NAME.json) add lights and environment. The parameters are documented in objects/generators.hpp.

#include "capture/tracer/scene/scene.hpp"
#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace rs::synthetic {

/// Names of all objects, in display order.
std::vector<std::string> object_names();

/// Generates an object. Thread-safe. Takes 0.1 to 2 s.
/// \param name one of object_names()
/// \param parameters a JSON object, or null for all defaults
/// \return an error for an unknown name or parameter, or a value out of range; the message lists the valid ones
Result<capture::Scene> generate(const std::string& name, const nlohmann::json& parameters, std::uint64_t seed);

}  // namespace rs::synthetic
