#pragma once
// By which the farm knows results and orders again: XXH64 as 16 hexadecimal digits.

#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace rs::farm {

struct ToolOrder;

std::string sum_text(std::string_view bytes);

// Of a file its bytes; of a folder that a StagedFolder made the list of its files with their sums. Fails where the
// result, or a file of that list, is not there. Reads a file whole, of a folder the list.
Result<std::string> sum_of_result(const std::filesystem::path& path);

// Of the version of the tools, of tool and arguments, and of the names of all files in the folder.
std::string key_of(const ToolOrder& order);

}  // namespace rs::farm
