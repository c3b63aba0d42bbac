#pragma once
// Scenes of other formats: a program of the user's turns them into a sequence's files.

#include "rayspace/base/result.hpp"
#include "rayspace/file/file_output.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs::compositor {

// The words of a command, parted by blanks; '...' and "..." hold words together, nothing else has a meaning. {in} and
// {out} are replaced wherever they stand; both must be there. Pure.
Result<std::vector<std::string>> converter_words(const std::string& command, const std::filesystem::path& in,
                                                 const std::filesystem::path& out);

// What a converter has written, until this is dropped.
struct Converted {
    StagedFolder folder;         // never committed
    std::filesystem::path path;  // {out}, which the converter has made: a folder or a file
};

// Runs the command without a shell, with no input and its output on this program's stderr, and waits for it. An error
// where it cannot be run, does not end with 0 or has left nothing at {out}.
Result<Converted> convert_scene(const std::string& command, const std::filesystem::path& in);

}  // namespace rs::compositor
