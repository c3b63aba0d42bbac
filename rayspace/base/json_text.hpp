#pragma once
// JSON text that others wrote: scenes, recipes, rigs, boards, conformance vectors, all with the same limits and words.

#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace rs {

// Errors, which name `where` and the line: text that is no JSON, brackets that nest more than 64 deep, a number that is
// out of range, and an object that names a key twice. Pure; thread-safe.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& where);

}  // namespace rs
