#pragma once
// Encoders that are programs of their own.

#include "rayspace/base/result.hpp"

#include <string>
#include <vector>

namespace rs::bench {

// Runs argv[0] (looked up in PATH) with the other arguments, no shell between, and waits; returns what it printed on
// stdout and stderr together. Errors: there is no such program; it did not end with 0 (its last line is in the error).
Result<std::string> run_tool(const std::vector<std::string>& argv);

}  // namespace rs::bench
