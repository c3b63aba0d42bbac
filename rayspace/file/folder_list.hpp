#pragma once
// The list of its files that a StagedFolder leaves in a folder, as others read it.

#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rs {

// The list's own file. Its bytes differ where any of the folder's do: it has their sums.
std::filesystem::path list_of_files(const std::filesystem::path& folder);

// The files that it names, relative to the folder, whether they are there or not. Fails where there is no list.
Result<std::vector<std::string>> listed_files(const std::filesystem::path& folder);

}  // namespace rs
