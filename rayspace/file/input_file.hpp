#pragma once
// Opens input files without ever blocking on a pipe or a device.

#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace rs {

/// \return a descriptor open for reading, which the caller closes, or an error if `path` is no regular file: reading a
///     pipe may block, and a device may have no end.
Result<int> open_input(const std::filesystem::path& path);

/// The same check, for libraries that open files by name.
Status check_input(const std::filesystem::path& path);

/// Text without the UTF-8 byte order mark that editors on Windows write.
std::string_view without_byte_order_mark(std::string_view text);

/// \return ".png" for "a/B.PNG", empty if there is no extension.
std::string lower_case_extension(const std::filesystem::path& path);

}  // namespace rs
