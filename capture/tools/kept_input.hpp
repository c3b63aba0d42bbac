#pragma once
// Output folders must not swallow what they are made of.

#include "rayspace/base/result.hpp"

#include <filesystem>

namespace rs::capture {

// A set's folder is replaced whole, with whatever stands in it: an error where `input` (may be empty) lies within
// `output`, links followed.
Status check_output_keeps(const std::filesystem::path& output, const std::filesystem::path& input);

}  // namespace rs::capture
