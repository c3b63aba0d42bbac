#pragma once
// Runs rs-capture import for several turns of one object and prints the summary.

#include "capture/photos/import.hpp"
#include "capture/turns/turns_import.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::capture {

/// Turns of the given folders, or nothing if they are one turn: a video, or a folder of photos in a single row.
Result<std::vector<TurnSource>> several_turns(const std::vector<std::filesystem::path>& folders);

/// Imports the turns and prints the summary, as JSON if `json`, and the notes unless `quiet`. Error: `unused` options,
/// which only one turn has.
Status run_turns_import(const std::vector<TurnSource>& turns, const ImportOptions& options,
                        const std::vector<std::string>& unused, bool json, bool quiet);

}  // namespace rs::capture
