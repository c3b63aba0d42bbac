#pragma once
// Runs external encoders.

#include "rayspace/base/result.hpp"

#include <string>
#include <vector>

namespace rs::bench {

/// Runs argv[0] (searched in PATH) with the other arguments, without a shell, and waits for it.
/// \return its stdout and stderr combined. Fails if the program does not exist, or if its exit status is not 0; the
/// error contains the last line of the output.
Result<std::string> run_tool(const std::vector<std::string>& argv);

}  // namespace rs::bench
