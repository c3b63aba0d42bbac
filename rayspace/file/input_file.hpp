#pragma once
// Files that are read: opened without ever waiting for a pipe, and kept from being replaced by what is written.

#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs {

// A descriptor open for reading, which the caller closes. Refuses what is no regular file (a pipe would wait for ever,
// a device may never end), and the error states it. What is only looked at to see whether it may be replaced is no
// input. Thread-safe, as everything here.
Result<int> open_input(const std::filesystem::path& path, bool is_input = true);

// The same check for what a library opens by its name.
Status check_input(const std::filesystem::path& path);

// From now on whatever is opened or checked above, and whatever StagedFile has written, is not to be replaced by
// StagedFile or StagedFolder: a tool's output never costs its user an input, nor another output. Tools do this at their
// start (tool_main.hpp).
void keep_inputs();

// An error where `output` is one of these files, by whatever name, or a folder that holds one; always fine before
// keep_inputs().
Status check_keeps_inputs(const std::filesystem::path& output);

// `path` was written by this process.
void note_written(const std::filesystem::path& path);

// ".png" of "a/B.PNG"; empty where there is none.
std::string lower_case_extension(const std::filesystem::path& path);

}  // namespace rs
