#pragma once
// Opens input files without ever blocking on a pipe or a device.

#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>

namespace rs {

/// \return a descriptor open for reading, which the caller closes, or an error if `path` is no regular file: reading a
///     pipe may block, and a device may have no end.
Result<int> open_input(const std::filesystem::path& path);

/// The same check, for libraries that open files by name.
Status check_input(const std::filesystem::path& path);

/// \return ".png" for "a/B.PNG", empty if there is no extension.
std::string lower_case_extension(const std::filesystem::path& path);

}  // namespace rs
