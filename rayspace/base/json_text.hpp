#pragma once
// Parser of JSON text from outside (scenes, recipes, rigs, boards, conformance vectors), with common limits and
// messages.

#include "rayspace/base/result.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace rs {

/// Parses JSON text. Errors, which name `where` and the line: invalid JSON, brackets nested more than 64 deep, a number
/// out of range, a repeated key. Thread-safe.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& where);

}  // namespace rs
