#pragma once
// Import of other scene formats by a user-supplied converter program.

#include "rayspace/base/result.hpp"
#include "rayspace/file/file_output.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::compositor {

/// Splits a command at blanks; '...' and "..." group words, other characters are literal. Replaces {in} and {out}, both
/// of which must occur. Pure.
Result<std::vector<std::string>> parse_converter_command(const std::string& command, const std::filesystem::path& in,
                                                         const std::filesystem::path& out);

/// Output of a converter; deleted on destruction.
struct ConvertedScene {
    StagedFolder folder;         // never committed
    std::filesystem::path path;  // {out}: the folder or file that the converter created
};

/// Runs the command without a shell, stdin closed, stdout redirected to this program's stderr, and waits for it. Fails
/// if it cannot be run, its exit status is not 0, or {out} does not exist afterwards.
Result<ConvertedScene> convert_scene(const std::string& command, const std::filesystem::path& in);

}  // namespace rs::compositor
